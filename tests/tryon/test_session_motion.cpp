// A body of a session plays a clip: with pauses, seeks, a next body, and new shapes.

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <memory>

#include <bodice/binding/poser.hpp>
#include <bodice/tryon/session.hpp>
#include <bodice_test/allocations.hpp>
#include <bodice_test/executors.hpp>

#include "sheet.hpp"

using namespace bodice;
using geometry::Vec3;

namespace {

constexpr double kFrame_s = 1.0 / 60.0;

tryon::SessionOptions moving(proxy::Tier tier) {
  tryon::SessionOptions options;
  options.fit.tier = tier;
  options.fit.max_ellipsoids = 40;
  options.fit.measure_accuracy = false;
  options.moves = true;
  return options;
}

/// A session without workers: each frame does what is pending first.
std::unique_ptr<tryon::Session> walking(const char* motion = "walk") {
  auto session = std::make_unique<tryon::Session>(engine::Context{}, moving(proxy::Tier::kSolid));
  session->submit(synth::BodyOptions{.vertices = 2600});
  session->play({.motion = motion}, {.ramp_s = 0.1});
  REQUIRE(session->frame(kFrame_s).has_body);
  return session;
}

double height_of_left_knee(const tryon::Session& session) {
  const tryon::SegmentedSkin& skin = *session.body()->skin;
  std::vector<Vec3> at(skin.input.skin.positions.size());
  session.skin_positions(at);
  double low = 1e9;
  for (std::size_t v = 0; v < at.size(); ++v)
    if (skin.anatomy.part[v] == body::Part::kThighL) low = std::min(low, at[v].y());
  return low;
}

std::uint64_t hash_of_squats(engine::Executor& executor) {
  const engine::Context context{.executor = &executor};
  tryon::SessionOptions options = moving(proxy::Tier::kRelief);
  options.fit.max_ellipsoids = 24;
  options.pipeline.mode = engine::PipelineMode::kDeterministic;
  options.pipeline.delay_frames = 2;
  tryon::Session session(context, options);
  REQUIRE(session.dress({sheet(10)}).ok());
  session.submit(synth::BodyOptions{.vertices = 1500});
  session.play({.motion = "squat"}, {.ramp_s = 0.05});
  bool took_refit = false;
  for (int frame = 0; frame < 50; ++frame) {
    const tryon::FrameOutcome outcome = session.frame(2.0 * kFrame_s);
    took_refit = took_refit || outcome.took_refit;
    if (frame == 30) session.submit(synth::BodyOptions{.stature_m = 1.8, .vertices = 1500});
    if (frame == 40) session.seek(0.4, 0.1);
  }
  REQUIRE(session.body() != nullptr);
  CHECK(took_refit);
  return session.hash();
}

}  // namespace

TEST_CASE("a body reaches its clip by a ramp, plays it, stands while paused, and loops") {
  const auto walker = walking();
  tryon::Session& session = *walker;
  tryon::FrameOutcome outcome = session.frame(kFrame_s);
  REQUIRE(outcome.plays);
  CHECK(outcome.clip_s == 0.0);
  CHECK(outcome.ramp_left_s > 0.0);
  while (outcome.ramp_left_s > 0.0) outcome = session.frame(kFrame_s);
  const double begin_s = outcome.clip_s;
  for (int frame = 0; frame < 30; ++frame) outcome = session.frame(kFrame_s);
  CHECK(outcome.clip_s == doctest::Approx(begin_s + 0.5));
  const double knee_m = height_of_left_knee(session);
  session.pause();
  outcome = session.frame(kFrame_s);
  CHECK(outcome.clip_s == doctest::Approx(begin_s + 0.5));
  CHECK(height_of_left_knee(session) == knee_m);
  session.resume();
  session.seek(outcome.clip_s + 1.1 - kFrame_s, 0.0);  // a walk takes 1.1 s
  outcome = session.frame(kFrame_s);
  CHECK(height_of_left_knee(session) == doctest::Approx(knee_m).epsilon(1e-6));
}

TEST_CASE("a clip that ends far from its start loops without a jump") {
  const auto session = walking("sit");
  std::vector<Vec3> before(session->body()->skin->input.skin.positions.size()), now(before.size());
  for (int frame = 0; frame < 10; ++frame) session->frame(kFrame_s);  // the ramp from the bind pose
  session->skin_positions(before);
  double seated_m = 1e9, standing_m = 0.0, farthest_m = 0.0;
  for (int frame = 0; frame < 420; ++frame) {  // more than a lap
    session->frame(kFrame_s);
    session->skin_positions(now);
    for (std::size_t v = 0; v < now.size(); ++v)
      farthest_m = std::max(farthest_m, (now[v] - before[v]).norm());
    before.swap(now);
    const double height_m = geometry::bounding_box(before).high.y();
    seated_m = std::min(seated_m, height_m), standing_m = std::max(standing_m, height_m);
  }
  CHECK(standing_m - seated_m > 0.2);
  CHECK(farthest_m < 0.06);
}

TEST_CASE("tables near the garments are posed, tables beyond their reach stay as at rest") {
  tryon::SessionOptions options = moving(proxy::Tier::kRelief);
  options.fit.max_ellipsoids = 60;
  options.refits = false;
  tryon::Session session(engine::Context{}, options);
  REQUIRE(session.dress({sheet(10)}).ok());
  session.submit(synth::BodyOptions{.vertices = 2600});
  session.play({.motion = "squat"}, {.ramp_s = 0.1});
  for (int frame = 0; frame < 60; ++frame) session.frame(kFrame_s);
  REQUIRE(session.posed() != nullptr);

  const proxy::BodyProxy& bound = session.body()->proxy;
  const tryon::SegmentedSkin& skin = *session.body()->skin;
  std::vector<engine::Warning> warnings;
  const auto motion = tryon::find_motion({}, skin, {.motion = "squat", .clip = {}}, warnings);
  REQUIRE(motion);
  std::vector<rig::Affine> joints(motion->rig.skeleton.joints.size());
  rig::joint_matrices(motion->rig.skeleton, motion->clip, session.frame(0.0).clip_s, joints);
  auto whole = binding::Poser::make(bound);
  REQUIRE(whole);
  REQUIRE(whole->pose({}, joints));
  std::vector<Vec3> cloth(session.vertices());
  session.positions(cloth);

  int near = 0, at_rest = 0;
  for (std::size_t k = 0; k < bound.ellipsoids().size(); ++k) {
    const proxy::ReliefTable& table = bound.relief()[k];
    const std::size_t bytes =
        std::size_t{table.nodes_per_side} * table.nodes_per_side * sizeof(proxy::ReliefTexel);
    const auto same = [&](const proxy::ReliefTexel* texels) {
      return std::memcmp(&session.posed()->texels[table.first_texel], texels + table.first_texel, bytes) == 0;
    };
    double least_m = 1e9;
    for (const Vec3& at : cloth)
      least_m = std::min(least_m, geometry::closest_point(whole->posed().shapes[k], at).signed_distance);
    CAPTURE(k);
    CAPTURE(least_m);
    if (least_m < 0.05) {
      CHECK(same(whole->posed().texels.data()));
      ++near;
    } else if (least_m > 0.3) {
      CHECK(same(bound.texels().data()));
      ++at_rest;
    }
  }
  CHECK(near > 5);
  CHECK(at_rest > 5);
}

TEST_CASE("seeking by a ramp reaches the same pose as seeking at once") {
  const auto first = walking("squat"), second = walking("squat");
  tryon::Session &at_once = *first, &by_ramp = *second;
  at_once.frame(kFrame_s);  // the clip is found behind the first frame
  by_ramp.frame(kFrame_s);
  at_once.pause();
  at_once.seek(1.5, 0.0);
  at_once.frame(kFrame_s);
  by_ramp.seek(1.5, 0.25);
  for (int frame = 0; frame < 15; ++frame) by_ramp.frame(kFrame_s);
  by_ramp.pause();
  CHECK(by_ramp.frame(kFrame_s).clip_s == doctest::Approx(1.5));
  CHECK(height_of_left_knee(by_ramp) == doctest::Approx(height_of_left_knee(at_once)).epsilon(1e-6));
}

TEST_CASE("the next body continues the clip at the time of the last body") {
  const auto walker = walking();
  tryon::Session& session = *walker;
  for (int frame = 0; frame < 40; ++frame) session.frame(kFrame_s);
  const double before_s = session.frame(kFrame_s).clip_s;
  session.submit(synth::BodyOptions{.stature_m = 1.85, .mass_kg = 80, .vertices = 1500});
  const tryon::FrameOutcome outcome = session.frame(kFrame_s);
  CHECK(session.body()->proxy.stature_m() > 1.75);
  REQUIRE(outcome.plays);
  CHECK(outcome.clip_s == doctest::Approx(before_s + kFrame_s));
  CHECK(outcome.ramp_left_s == 0.0);
}

TEST_CASE("another clip is reached from the current pose, and an unknown one gives its ticket an error") {
  const auto walker = walking();
  tryon::Session& session = *walker;
  for (int frame = 0; frame < 20; ++frame) session.frame(kFrame_s);
  const double walking_m = height_of_left_knee(session);
  session.play({.motion = "reach"}, {.ramp_s = 1.0});
  const tryon::FrameOutcome outcome = session.frame(1e-4);
  CHECK(outcome.clip_s == 0.0);
  CHECK(height_of_left_knee(session) == doctest::Approx(walking_m).epsilon(0.01));
  const auto missing = session.play({.motion = "nowhere.bvh"}).wait();
  REQUIRE_FALSE(missing.ok());
  CHECK(missing.error().sentence().find("nowhere.bvh") != std::string::npos);
  CHECK(session.frame(kFrame_s).plays);  // the earlier clip plays on

  tryon::Session still({}, {.fit = {.tier = proxy::Tier::kSolid}});
  const auto refused = still.play({.motion = "walk"}).wait();
  REQUIRE_FALSE(refused.ok());
  CHECK(refused.error().code == engine::ErrorCode::kInvalidArgument);
}

TEST_CASE("held vertices move with the body") {
  const auto walker = walking();
  tryon::Session& session = *walker;
  REQUIRE(session.dress({sheet(10)}).ok());
  std::vector<Vec3> at(session.vertices());
  std::uint64_t contacts = 0;
  for (int frame = 0; frame < 60; ++frame) {
    const tryon::FrameOutcome outcome = session.frame(kFrame_s);
    CHECK(outcome.cloth.finite);
    contacts += outcome.cloth.contacts.contacts;
  }
  session.positions(at);
  CHECK(contacts > 0);
  CHECK(at[0].y() < 1.75);
}

TEST_CASE("with refits behind the frames a run repeats to the bit, whatever the workers") {
  std::uint64_t first = 0;
  for (const int workers : {1, 3, 7}) {
    CAPTURE(workers);
    const auto executor = bodice_test::make_threads(workers);
    const std::uint64_t hash = hash_of_squats(*executor);
    if (first == 0) first = hash;
    CHECK(hash == first);
  }
}

TEST_CASE("a frame of a dressed body that walks allocates nothing once warm") {
  if (!bodice_test::counts_allocations()) return;
  for (const int workers : {1, 2}) {
    CAPTURE(workers);
    const auto executor = bodice_test::make_threads(workers);
    tryon::SessionOptions options = moving(proxy::Tier::kRelief);
    options.fit.max_ellipsoids = 24;
    options.refits = false;
    tryon::Session session({.executor = executor.get()}, options);
    REQUIRE(session.dress({sheet(10)}).ok());
    auto body = session.submit(synth::BodyOptions{.vertices = 1500});
    session.play({.motion = "walk"}, {.ramp_s = 0.1});
    REQUIRE(body.wait().ok());
    for (int frame = 0; frame < 30; ++frame) session.frame(kFrame_s);
    CHECK(bodice_test::allocations_when_warm(5, [&] { session.frame(kFrame_s); }) == 0);
  }
}

TEST_CASE("a new shape takes effect on the skin while the clip plays on") {
  const auto walker = walking();
  tryon::Session& session = *walker;
  const tryon::SegmentedSkin& skin = *session.body()->skin;
  std::vector<Vec3> wider = skin.input.skin.positions;
  for (std::size_t v = 0; v < wider.size(); ++v) wider[v].x() *= 1.05, wider[v].z() *= 1.1;
  const std::uint64_t before = session.frame(kFrame_s).proxy_hash;
  REQUIRE(session.reshape(wider).ok());
  const tryon::FrameOutcome outcome = session.frame(kFrame_s);
  CHECK(outcome.proxy_hash != before);
  CHECK(outcome.plays);
  CHECK(session.body()->skin->input.skin.positions[7].z() == wider[7].z());

  wider.pop_back();
  const auto refused = session.reshape(wider);
  REQUIRE_FALSE(refused.ok());
  CHECK(refused.error().code == engine::ErrorCode::kInvalidArgument);
}
