// Base poses: their error against the exact signed distance of the posed skin, their files, and their use
// without a jump.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include <bodice/binding/poser.hpp>
#include <bodice/engine/random.hpp>
#include <bodice/geometry/sampling.hpp>
#include <bodice/proxy/proxy_file.hpp>
#include <bodice/rigging/motion.hpp>
#include <bodice/tryon/base_pose.hpp>
#include <bodice/tryon/rigged_body.hpp>
#include <bodice_test/executors.hpp>
#include <bodice_test/temp_folder.hpp>

using namespace bodice;
using geometry::Vec3;

namespace {

struct Body {
  tryon::PreparedBody body;
  std::vector<rig::Affine> seat;  ///< joints of the built-in seat, #J
};

const Body& sitter() {
  static const Body made = [] {
    const engine::Context context;
    const synth::BodyOptions builtin{.vertices = 8850};
    auto skin = tryon::segment_builtin(context, builtin, {});
    REQUIRE_MESSAGE(skin.ok(), skin.error().sentence());
    REQUIRE(tryon::give_rig(context, builtin, *skin).ok());
    auto body = tryon::fit_bound_proxy(context, std::move(*skin), {.measure_accuracy = false});
    REQUIRE_MESSAGE(body.ok(), body.error().sentence());
    const rig::Skeleton& skeleton = body->skin.rig->skeleton;
    const auto sit = rigging::make_clip(skeleton, rigging::Motion::kSit);
    REQUIRE_MESSAGE(sit.ok(), sit.error().sentence());
    std::vector<rig::Affine> seat(skeleton.joints.size());
    rig::joint_matrices(skeleton, *sit, 2.5, seat);
    return Body{std::move(body).value(), std::move(seat)};
  }();
  return made;
}

std::shared_ptr<const proxy::BasePose> seated(const engine::Context& context = {}) {
  auto base =
      tryon::make_base_pose(context, sitter().body.fit.proxy, sitter().body.skin, sitter().seat, "seat");
  REQUIRE_MESSAGE(base.ok(), base.error().sentence());
  return *base;
}

binding::Poser poser() {
  auto made = binding::Poser::make(sitter().body.fit.proxy);
  REQUIRE(made);
  return std::move(made).value();
}

geometry::TriMesh skin_at(std::span<const rig::Affine> joints) {
  const tryon::SegmentedSkin& skin = sitter().body.skin;
  std::vector<rig::Affine> skinning(joints.size());
  rig::skinning_matrices(skin.rig->skeleton, joints, skinning);
  geometry::TriMesh posed = skin.input.skin;
  rig::skin_linear(skin.input.skin.positions, skin.rig->weights, skinning, posed.positions);
  return posed;
}

/// Points within 30 mm of the posed skin with their exact distances. Points in or under skin that overlaps
/// itself are left out.
std::vector<std::pair<Vec3, double>> truth_at(std::span<const rig::Affine> joints) {
  const geometry::TriMesh skin = skin_at(joints);
  const geometry::MeshDistance distance({}, skin);
  const engine::Random random(5);
  std::vector<std::pair<Vec3, double>> truth;
  std::uint64_t draw = 0;
  for (const auto& sample : geometry::sample_surface(skin, 3000, 7)) {
    const Vec3 normal = geometry::area_vector(skin, sample.triangle).normalized();
    const Vec3 point = sample.point + (0.06 * random.uniform_at(draw++) - 0.03) * normal;
    const auto nearest = distance.closest_point(point);
    if (std::abs(nearest.signed_distance) > 0.03 || distance.winding_number(point) > 1.5) continue;
    if (nearest.signed_distance < 0.0 && distance.winding_number(nearest.point + 1e-4 * nearest.normal) > 0.5)
      continue;
    truth.emplace_back(point, nearest.signed_distance);
  }
  REQUIRE(truth.size() > 2000);
  return truth;
}

double distance_mm(const binding::Poser& posed, const Vec3& point) {
  return 1e3 * proxy::posed_proxy_distance(posed.bound(), posed.posed(), point).distance;
}

/// Mean and 95th percentile of the error, millimeters.
std::pair<double, double> errors_mm(const binding::Poser& posed,
                                    const std::vector<std::pair<Vec3, double>>& truth) {
  std::vector<double> errors;
  double sum = 0.0;
  for (const auto& [point, exact_m] : truth) {
    errors.push_back(std::abs(distance_mm(posed, point) - 1e3 * exact_m));
    sum += errors.back();
  }
  std::ranges::sort(errors);
  return {sum / static_cast<double>(errors.size()), errors[errors.size() * 95 / 100]};
}

bool same_bytes(const proxy::BasePose& a, const proxy::BasePose& b) {
  return a.name == b.name && std::ranges::equal(a.joints, b.joints) &&
         std::ranges::equal(a.relief, b.relief,
                            [](const auto& x, const auto& y) {
                              return x.h_scale_m == y.h_scale_m && x.h_offset_m == y.h_offset_m &&
                                     x.a_scale == y.a_scale && x.a_offset == y.a_offset;
                            }) &&
         std::ranges::equal(a.texels, b.texels,
                            [](const auto& x, const auto& y) { return x.h == y.h && x.a == y.a; });
}

}  // namespace

TEST_CASE(
    "tables solved anew for a seat have a mean error below 0.4 mm, less than tables carried from rest") {
  const auto truth = truth_at(sitter().seat);
  binding::Poser posed = poser();
  REQUIRE(posed.pose({}, sitter().seat));
  const auto [carried_mm, carried_p95_mm] = errors_mm(posed, truth);
  REQUIRE(posed.add_base(seated()));
  REQUIRE(posed.pose({}, sitter().seat));
  const auto [mean_mm, p95_mm] = errors_mm(posed, truth);
  CAPTURE(carried_mm);
  CAPTURE(carried_p95_mm);
  CAPTURE(mean_mm);
  CAPTURE(p95_mm);
  CHECK(mean_mm < 0.4);
  CHECK(p95_mm < 1.6);
  CHECK(mean_mm < 0.85 * carried_mm);
}

TEST_CASE("a base pose does not change the proxy at rest") {
  std::vector<rig::Affine> rest;
  for (const rig::Joint& joint : sitter().body.skin.rig->skeleton.joints) rest.push_back(joint.bind);
  const auto truth = truth_at(rest);
  binding::Poser posed = poser();
  REQUIRE(posed.pose({}, rest));
  const double without_mm = errors_mm(posed, truth).first;
  REQUIRE(posed.keep_base(seated()));
  REQUIRE(posed.pose({}, rest));
  CHECK(errors_mm(posed, truth).first < 1.02 * without_mm);
  CHECK(posed.departure_rad(rest) < 1e-3);
  CHECK(posed.departure_rad(sitter().seat) < 1e-3);
}

TEST_CASE("a refit has the same bits for 1, 2, 3 and 7 workers") {
  const auto first = seated();
  for (const int workers : {1, 2, 3, 7}) {
    const auto executor = bodice_test::make_threads(workers);
    CHECK(same_bytes(*seated({.executor = executor.get()}), *first));
  }
}

TEST_CASE("a base pose that comes into use over ten poses moves the surface a little in each") {
  const auto base = seated();
  const auto truth = truth_at(sitter().seat);
  const auto farthest_mm = [&](int poses) {
    binding::Poser posed = poser();
    REQUIRE(posed.pose({}, sitter().seat));
    std::vector<double> before;
    for (const auto& [point, exact_m] : truth) before.push_back(distance_mm(posed, point));
    REQUIRE(posed.add_base(base, poses));
    double most = 0.0;
    for (int pose = 0; pose < 12; ++pose) {
      REQUIRE(posed.pose({}, sitter().seat));
      for (std::size_t i = 0; i < truth.size(); ++i) {
        const double now = distance_mm(posed, truth[i].first);
        if (std::abs(truth[i].second) < 0.005) most = std::max(most, std::abs(now - before[i]));
        before[i] = now;
      }
    }
    return most;
  };
  const double at_once_mm = farthest_mm(0), blended_mm = farthest_mm(10);
  CAPTURE(at_once_mm);
  CAPTURE(blended_mm);
  CHECK(blended_mm < 0.6 * at_once_mm);
}

TEST_CASE("base poses are saved with their proxy as text and binary; readers of the proxy alone skip them") {
  const bodice_test::TempFolder folder;
  const proxy::BodyProxy& bound = sitter().body.fit.proxy;
  const proxy::ProxyWithBases both{bound, {seated(), seated()}};
  for (const char* name : {"seat.bodice", "seat.json"}) {
    CAPTURE(name);
    const auto file = folder / name;
    REQUIRE(proxy::save_with_bases(both, file).ok());
    const auto alone = proxy::load(file);
    REQUIRE_MESSAGE(alone.ok(), alone.error().sentence());
    CHECK(alone->hash() == bound.hash());
    const auto back = proxy::load_with_bases(file);
    REQUIRE_MESSAGE(back.ok(), back.error().sentence());
    REQUIRE(back->bases.size() == 2);
    CHECK(same_bytes(*back->bases[1], *both.bases[1]));
    REQUIRE(proxy::save(bound, file).ok());
    const auto none = proxy::load_with_bases(file);
    REQUIRE_MESSAGE(none.ok(), none.error().sentence());
    CHECK(none->bases.empty());
  }
}

TEST_CASE("base poses that are damaged or belong to another proxy are refused with one sentence") {
  const bodice_test::TempFolder folder;
  const proxy::BodyProxy& bound = sitter().body.fit.proxy;
  const auto file = folder / "seat.bodice";
  REQUIRE(proxy::save_with_bases({bound, {seated()}}, file).ok());
  std::fstream bytes(file, std::ios::in | std::ios::out | std::ios::binary);
  bytes.seekp(-200, std::ios::end);
  bytes.put('\x55').put('\x55');
  bytes.close();
  const auto damaged = proxy::load_with_bases(file);
  REQUIRE_FALSE(damaged.ok());
  CHECK(damaged.error().sentence().find("seat.bodice") != std::string::npos);
  CHECK(proxy::load(file).ok());  // the proxy itself is whole

  proxy::BasePose other = *seated();
  other.joints.pop_back();
  CHECK_FALSE(proxy::check_base(bound, other).ok());
  CHECK_FALSE(poser().add_base(std::make_shared<const proxy::BasePose>(other)).ok());
  other = *seated();
  other.joints[3](1, 2) = std::nan("");
  const auto bad = proxy::check_base(bound, other);
  REQUIRE_FALSE(bad.ok());
  CHECK(bad.error().sentence().find(bound.binding()->joint_names[3]) != std::string::npos);
}

TEST_CASE("a prepared clip has a base pose near each of its poses, ordered by time") {
  const Body& b = sitter();
  std::vector<engine::Warning> warnings;
  const auto motion = tryon::find_motion({}, b.body.skin, {.motion = "sit"}, warnings);
  REQUIRE(motion);
  tryon::BodyMotion half = *motion;
  half.clip.duration_s = 0.9;  // a third of the clip, for the sake of time
  const auto bases = tryon::make_base_poses({}, b.body.fit.proxy, b.body.skin, half);
  REQUIRE_MESSAGE(bases.ok(), bases.error().sentence());
  CHECK(bases->size() > 1);
  binding::Poser posed = poser();
  for (const auto& base : *bases) REQUIRE(posed.keep_base(base));
  std::vector<rig::Affine> joints(b.seat.size());
  for (double time_s = 0.0; time_s <= 0.9; time_s += 0.1) {
    rig::joint_matrices(half.rig.skeleton, half.clip, time_s, joints);
    CHECK(posed.departure_rad(joints) < 1.6 * tryon::kPreparedTurn_rad);
  }
}
