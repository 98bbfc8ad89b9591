// A moving body: the sources of its motion, and drapes on it.

#include <doctest/doctest.h>

#include <algorithm>
#include <memory>
#include <string>

#include <bodice/binding/poser.hpp>
#include <bodice/tryon/base_pose.hpp>
#include <bodice/tryon/drape.hpp>
#include <bodice/tryon/rigged_body.hpp>
#include <bodice/tryon/wearing.hpp>
#include <bodice_test/executors.hpp>
#include <bodice_test/shapes.hpp>

#include "builtin.hpp"

using namespace bodice;
using geometry::Vec3;

namespace {

constexpr int kWalkerVertices = 4500;

struct Walker {
  tryon::PreparedBody body;
  tryon::BodyMotion motion;
  std::vector<tryon::WornGarment> worn;
};

/// The skin of thighs and lower trunk, 5 mm off, and its vertices in the skin.
tryon::WornGarment tight_shorts(const tryon::SegmentedSkin& body, std::vector<geometry::Index>& under) {
  using body::Part;
  const auto is_covered = [&](geometry::Index v) {
    const Part part = body.anatomy.part[v];
    return part == Part::kThighL || part == Part::kThighR || part == Part::kTorsoLL || part == Part::kTorsoLR;
  };
  const geometry::TriMesh& skin = body.input.skin;
  const std::vector<Vec3> normals = geometry::vertex_normals(skin);
  std::vector<geometry::Index> own(skin.positions.size(), geometry::kNoIndex);
  tryon::WornGarment shorts{.name = "shorts", .mesh = {}, .held = {}};
  for (const geometry::Triangle& t : skin.triangles) {
    if (!std::ranges::all_of(t, is_covered)) continue;
    geometry::Triangle& cut = shorts.mesh.triangles.emplace_back();
    for (std::size_t c = 0; c < 3; ++c) {
      if (own[t[c]] == geometry::kNoIndex) {
        own[t[c]] = static_cast<geometry::Index>(under.size());
        under.push_back(t[c]);
        shorts.mesh.positions.push_back(skin.positions[t[c]] + 0.005 * normals[t[c]]);
      }
      cut[c] = own[t[c]];
    }
  }
  return shorts;
}

/// The body with a skirt, playing a made motion.
Walker walker(const engine::Context& context, const tryon::PreparedBody& body, const char* motion) {
  std::vector<engine::Warning> warnings;
  auto found = tryon::find_motion(context, body.skin, {.motion = motion}, warnings);
  REQUIRE_MESSAGE(found.ok(), found.error().sentence());
  CHECK(warnings.empty());
  auto garment = tryon::make_garment(context, body.skin, {.kind = synth::GarmentKind::kSkirt});
  REQUIRE_MESSAGE(garment.ok(), garment.error().sentence());
  std::vector<tryon::WornGarment> worn{std::move(garment).value()};
  return {body, std::move(found).value(), std::move(worn)};
}

/// The built-in body, which is fitted once, as a walker.
Walker walker(const engine::Context& context, const char* motion, proxy::Tier tier = proxy::Tier::kSolid) {
  return walker(context, bound_builtin_body(kWalkerVertices, tier), motion);
}

}  // namespace

TEST_CASE("a made motion is found by its name without a file, and a missing file is refused by its name") {
  const synth::BodyOptions builtin{.vertices = 2600};
  auto rigged = tryon::segment_builtin({}, builtin, {});
  REQUIRE_MESSAGE(rigged.ok(), rigged.error().sentence());
  REQUIRE(tryon::give_rig({}, builtin, *rigged).ok());
  std::vector<engine::Warning> warnings;
  CHECK(tryon::find_motion({}, *rigged, {.motion = "walk"}, warnings).ok());
  const auto missing = tryon::find_motion({}, *rigged, {.motion = "no_such_file.glb"}, warnings);
  REQUIRE(!missing.ok());
  CHECK(missing.error().sentence().find("no_such_file.glb") != std::string::npos);
}

TEST_CASE("a skirt stays on a walking body, and each kept frame is measured against the posed skin") {
  const auto executor = bodice_test::make_threads(2);
  const engine::Context context{.executor = executor.get()};
  const Walker w = walker(context, "walk");
  tryon::DrapeOptions options{.frames = 33, .kept_frames = 4, .motion = &w.motion};
  options.solver.substeps = 8;
  const auto draped = tryon::drape(context, w.body, w.worn, options);
  REQUIRE_MESSAGE(draped.ok(), draped.error().sentence());
  const tryon::DrapeReport& report = draped->report;
  CHECK(report.finite);
  CHECK(report.ramp_s > 0.0);
  REQUIRE(report.kept.size() == 4);
  REQUIRE(draped->body_frames.size() == 4);
  for (std::size_t k = 0; k < 4; ++k) {
    CHECK(report.kept[k].time_s == doctest::Approx(11.0 * static_cast<double>(k) / 60.0));
    CHECK(report.kept[k].proxy_error.samples > 2000);
    // The posed skin, by the rig alone.
    std::vector<rig::Affine> world(w.motion.rig.skeleton.joints.size()), skinning(world.size());
    rig::joint_matrices(w.motion.rig.skeleton, w.motion.clip, report.kept[k].time_s, world);
    rig::skinning_matrices(w.motion.rig.skeleton, world, skinning);
    std::vector<Vec3> posed(w.body.skin.input.skin.positions.size());
    rig::skin_linear(w.body.skin.input.skin.positions, w.motion.rig.weights, skinning, posed);
    double farthest = 0.0;
    for (std::size_t v = 0; v < posed.size(); ++v)
      farthest = std::max(farthest, (posed[v] - draped->body_frames[k][v]).norm());
    CHECK(farthest < 1e-9);
  }
  double low = 1e9, high = -1e9;
  for (const Vec3& p : draped->garments[0].frames.back())
    low = std::min(low, p.y()), high = std::max(high, p.y());
  CHECK(low > 0.2 * 1.68);
  CHECK(high < 0.7 * 1.68);
}

TEST_CASE("on a squatting body a small thickness suffices, because the posed proxy covers the skin") {
  Walker w = walker({}, "squat", proxy::Tier::kRelief);
  const tryon::SegmentedSkin& skin = w.body.skin;
  std::vector<geometry::Index> under;  // the vertices of the skin under a tight garment
  w.worn = {tight_shorts(skin, under)};
  tryon::DrapeOptions options{.frames = 1, .kept_frames = 2, .motion = &w.motion, .ramp_s = 0.0};
  options.solver.substeps = 1;
  const auto draped = tryon::drape({}, w.body, w.worn, options);
  REQUIRE_MESSAGE(draped.ok(), draped.error().sentence());
  const double kept_m = draped->report.thickness_m - 0.5e-3;
  auto poser = binding::Poser::make(w.body.fit.proxy);
  REQUIRE(poser);
  collision::Collider carried(w.body.fit.proxy), covering(w.body.fit.proxy);
  std::vector<rig::Affine> world(w.motion.rig.skeleton.joints.size()), skinning(world.size());
  std::vector<Vec3> posed(skin.input.skin.positions.size());
  int beyond_carried = 0, beyond_covering = 0;
  constexpr int kTimes = 7;
  for (int i = 0; i < kTimes; ++i) {
    rig::joint_matrices(w.motion.rig.skeleton, w.motion.clip, w.motion.clip.duration_s * (i + 0.5) / kTimes,
                        world);
    rig::skinning_matrices(w.motion.rig.skeleton, world, skinning);
    rig::skin_linear(skin.input.skin.positions, w.motion.rig.weights, skinning, posed);
    REQUIRE(poser->pose({}, world));
    for (collision::Collider* collider : {&carried, &covering}) REQUIRE(collider->pose(poser->posed(), 0.0));
    covering.cover({}, posed);
    const auto out_m = [&](const collision::Collider& collider, geometry::Index v) {
      const Eigen::Vector3f local = (posed[v] - collider.origin()).cast<float>();
      return double{collider.query({local.x(), local.y(), local.z()}).signed_distance};
    };
    for (const geometry::Index v : under) {
      beyond_carried += out_m(carried, v) > kept_m;
      beyond_covering += out_m(covering, v) > kept_m;
    }
  }
  const double points = kTimes * static_cast<double>(under.size());
  MESSAGE((1e3 * draped->report.thickness_m) << " mm kept; " << beyond_carried << " and " << beyond_covering
                                             << " of " << points << " stand out by more");
  CHECK(draped->report.thickness_m < 1.5e-3);
  CHECK(beyond_carried > 0.05 * points);
  CHECK(beyond_covering < 0.015 * points);
}

TEST_CASE("a prepared clip has a smaller proxy error in its frames, as far as it is played") {
  Walker w = walker({}, "squat", proxy::Tier::kRelief);
  w.worn = {{.name = "sheet", .mesh = bodice_test::sheet(0.1, 0.1, 2, 2), .held = {}}};
  for (Vec3& p : w.worn[0].mesh.positions) p.y() += 3.0;  // high enough to meet nothing
  tryon::DrapeOptions options{.frames = 2, .dt_s = 0.5, .kept_frames = 3, .motion = &w.motion};
  options.solver.substeps = 1;
  std::vector<std::string> stages;
  const auto prepared =
      tryon::drape({}, w.body, w.worn, options, [&](std::string_view stage, double fraction) {
        CHECK(fraction <= 1.0);
        if (stages.empty() || stages.back() != stage) stages.emplace_back(stage);
      });
  options.prepare_clip = false;
  const auto carried = tryon::drape({}, w.body, w.worn, options);
  REQUIRE_MESSAGE(prepared.ok(), prepared.error().sentence());
  REQUIRE_MESSAGE(carried.ok(), carried.error().sentence());
  CHECK(stages == std::vector<std::string>{"prepare", "drape"});
  CHECK(carried->report.base_poses == 0);
  CHECK(prepared->report.base_poses > 2);
  const auto whole = tryon::make_base_poses({}, w.body.fit.proxy, w.body.skin, w.motion);
  REQUIRE(whole.ok());
  CHECK(whole->size() > prepared->report.base_poses);
  const tryon::KeptFrame &near = prepared->report.kept[2], &far = carried->report.kept[2];
  CHECK(near.time_s == 1.0);
  CHECK(near.proxy_error.error_m.mean < 0.85 * far.proxy_error.error_m.mean);
}

TEST_CASE("cloth collides with the proxy of the prepared clip, not only the report uses it") {
  Walker w = walker({}, "walk", proxy::Tier::kRelief);
  std::vector<geometry::Index> under;
  w.worn = {tight_shorts(w.body.skin, under)};
  tryon::DrapeOptions options{
      .frames = 2, .kept_frames = 2, .thickness_m = 0.0015, .motion = &w.motion, .ramp_s = 0.0};
  options.solver.substeps = 2;
  const auto prepared = tryon::drape({}, w.body, w.worn, options);
  options.prepare_clip = false;
  const auto carried = tryon::drape({}, w.body, w.worn, options);
  REQUIRE_MESSAGE(prepared.ok(), prepared.error().sentence());
  REQUIRE_MESSAGE(carried.ok(), carried.error().sentence());
  REQUIRE(prepared->report.base_poses > 0);
  CHECK(prepared->report.hash != carried->report.hash);
}

TEST_CASE("a drape on a moving body has the same bits for 1, 3 and 7 workers") {
  std::uint64_t first = 0;
  for (const int workers : {1, 3, 7}) {
    const auto executor = bodice_test::make_threads(workers);
    const engine::Context context{.executor = executor.get()};
    const Walker w =
        walker(context, make_bound_builtin_body(context, kWalkerVertices, proxy::Tier::kSolid), "reach");
    tryon::DrapeOptions options{.frames = 6, .kept_frames = 2, .motion = &w.motion};
    options.solver.substeps = 4;
    const auto draped = tryon::drape(context, w.body, w.worn, options);
    REQUIRE_MESSAGE(draped.ok(), draped.error().sentence());
    if (first == 0) first = draped->report.hash;
    CHECK(draped->report.hash == first);
  }
}

TEST_CASE("without a ramp the first kept frame shows the clip's first pose, not the bind pose") {
  Walker w = walker({}, "walk");
  // The case looks at the body alone, so that a small sheet above the head is cloth enough.
  geometry::TriMesh sheet = bodice_test::sheet(0.2, 0.2, 4, 4);
  for (Vec3& p : sheet.positions) p.y() += w.body.skin.anatomy.stature_m + 0.1;
  w.worn = {{.name = "sheet", .mesh = std::move(sheet)}};
  tryon::DrapeOptions options{.frames = 1, .kept_frames = 2, .motion = &w.motion, .ramp_s = 0.0};
  options.solver.substeps = 2;
  const auto draped = tryon::drape({}, w.body, w.worn, options);
  REQUIRE_MESSAGE(draped.ok(), draped.error().sentence());
  REQUIRE(draped->body_frames.size() == 2);
  std::vector<rig::Affine> world(w.motion.rig.skeleton.joints.size()), skinning(world.size());
  rig::joint_matrices(w.motion.rig.skeleton, w.motion.clip, 0.0, world);
  rig::skinning_matrices(w.motion.rig.skeleton, world, skinning);
  const std::vector<Vec3>& rest = w.body.skin.input.skin.positions;
  std::vector<Vec3> posed(rest.size());
  rig::skin_linear(rest, w.motion.rig.weights, skinning, posed);
  double from_clip_m = 0.0, from_bind_m = 0.0;
  for (std::size_t v = 0; v < rest.size(); ++v) {
    from_clip_m = std::max(from_clip_m, (draped->body_frames[0][v] - posed[v]).norm());
    from_bind_m = std::max(from_bind_m, (draped->body_frames[0][v] - rest[v]).norm());
  }
  CHECK(from_clip_m < 1e-9);
  CHECK(from_bind_m > 0.05);
}

TEST_CASE("a drape of a looping clip returns to the clip's start without a jump, and returns all laps") {
  Walker w = walker({}, "walk");
  w.motion.clip.duration_s *= 0.4;  // its end is far from its start
  geometry::TriMesh sheet = bodice_test::sheet(0.2, 0.2, 4, 4);
  for (Vec3& p : sheet.positions) p.y() += w.body.skin.anatomy.stature_m + 0.1;
  w.worn = {{.name = "sheet", .mesh = std::move(sheet)}};
  tryon::DrapeOptions options{.frames = 60, .kept_frames = 61, .motion = &w.motion, .ramp_s = 0.0};
  options.loop = true;
  options.solver.substeps = 2;
  REQUIRE(w.motion.clip.duration_s < 0.5 * options.frames * options.dt_s);
  const auto draped = tryon::drape({}, w.body, w.worn, options);
  REQUIRE_MESSAGE(draped.ok(), draped.error().sentence());
  CHECK(draped->clip.duration_s == doctest::Approx(options.frames * options.dt_s));
  REQUIRE(draped->body_frames.size() == 61);
  const auto farthest_m = [&](std::size_t i, std::size_t j) {
    double most = 0.0;
    for (std::size_t v = 0; v < draped->body_frames[i].size(); ++v)
      most = std::max(most, (draped->body_frames[i][v] - draped->body_frames[j][v]).norm());
    return most;
  };
  const auto end = static_cast<std::size_t>(w.motion.clip.duration_s / options.dt_s);
  double fastest_m = 0.0, fastest_in_clip_m = 0.0;
  for (std::size_t frame = 1; frame <= 60; ++frame) {
    fastest_m = std::max(fastest_m, farthest_m(frame, frame - 1));
    if (frame <= end) fastest_in_clip_m = std::max(fastest_in_clip_m, farthest_m(frame, frame - 1));
  }
  CHECK(farthest_m(end, 0) > 4.0 * fastest_in_clip_m);  // the distance of a jump
  CHECK(fastest_m < 2.5 * fastest_in_clip_m);
}

TEST_CASE("a proxy that is bound to another rig is refused, and the message has both numbers of joints") {
  Walker w = walker({}, "walk");
  auto other = std::make_shared<rig::Rig>(*w.body.skin.rig);
  const std::size_t joints = other->skeleton.joints.size();
  other->skeleton.joints.push_back({.name = "tail", .parent = 0});
  w.body.skin.rig = other;
  const auto draped = tryon::drape({}, w.body, w.worn, {.frames = 1, .motion = &w.motion});
  REQUIRE(!draped.ok());
  CHECK(draped.error().message == "The body's rig has " + std::to_string(joints + 1) +
                                      " joints, but its proxy is bound to " + std::to_string(joints) + ".");
}
