#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include <bodice/engine/random.hpp>
#include <bodice/rig/rig.hpp>

#include "chains.hpp"

using namespace bodice::rig;
using Eigen::Quaterniond;

namespace {

/// One joint with keys of one kind; its translation at a time.
Vec3 translation_at(const Keys<Vec3>& keys, double time_s, Playback playback = Playback::kClamp) {
  Skeleton skeleton;
  skeleton.joints.resize(1);
  Clip clip{"x", keys.time_s.back(), {}};
  clip.tracks.resize(1);
  clip.tracks[0].translation = keys;
  std::vector<LocalTransform> local(1);
  sample(skeleton, clip, time_s, local, playback);
  return local[0].translation;
}

Quaterniond about_z(double angle) {
  return Quaterniond(Eigen::AngleAxisd(angle, Vec3::UnitZ()));
}

}  // namespace

TEST_CASE(
    "clip: step keys hold until the next key, linear ones go straight, and both clamp before and after") {
  Keys<Vec3> keys{Interpolation::kStep, {1.0, 2.0, 4.0}, {{1, 0, 0}, {2, 0, 0}, {8, 0, 0}}};
  CHECK(translation_at(keys, 0.0).x() == 1.0);
  CHECK(translation_at(keys, 1.999).x() == 1.0);
  CHECK(translation_at(keys, 2.0).x() == 2.0);
  CHECK(translation_at(keys, 9.0).x() == 8.0);
  keys.interpolation = Interpolation::kLinear;
  CHECK(translation_at(keys, -3.0).x() == 1.0);
  CHECK(translation_at(keys, 1.25).x() == 1.25);
  CHECK(translation_at(keys, 3.0).x() == 5.0);
  CHECK(translation_at(keys, 4.5).x() == 8.0);
}

TEST_CASE("clip: cubic keys follow any cubic polynomial with its derivatives as tangents") {
  const auto p = [](double t) { return Vec3(1 + t - 2 * t * t + t * t * t, t * t * t, 2 - t); };
  const auto d = [](double t) { return Vec3(1 - 4 * t + 3 * t * t, 3 * t * t, -1.0); };
  Keys<Vec3> keys{Interpolation::kCubic, {0.0, 0.7, 2.0}, {}};
  for (const double t : keys.time_s) keys.value.insert(keys.value.end(), {d(t), p(t), d(t)});
  for (const double t : {0.0, 0.1, 0.35, 0.7, 1.1, 1.9, 2.0})
    CHECK((translation_at(keys, t) - p(t)).norm() < 1e-12);
}

TEST_CASE(
    "clip: a linear rotation turns at a constant rate along the shorter arc, whatever the signs of its "
    "keys") {
  const bodice::rig::Rig rig = rig_test::arm();
  Clip clip = rig_test::elbow_bent_90();
  for (const double sign : {1.0, -1.0}) {
    clip.tracks[0].rotation.value[1].coeffs() *= sign;
    std::vector<LocalTransform> local(2);
    for (const double t : {0.0, 0.25, 0.5, 1.0}) {
      sample(rig.skeleton, clip, t, local);
      CHECK(local[1].rotation.angularDistance(about_z(t * std::numbers::pi / 2)) < 1e-9);
    }
  }
}

TEST_CASE("clip: a loop repeats at every whole duration, before 0 too; odd times stand for the nearest end") {
  const Keys<Vec3> keys{Interpolation::kLinear, {0.0, 2.0}, {{0, 0, 0}, {2, 0, 0}}};
  for (const double t : {0.25, 1.0, 1.75})
    for (const double laps : {-3.0, -1.0, 1.0, 50.0})
      CHECK(translation_at(keys, t + 2.0 * laps, Playback::kLoop).x() == doctest::Approx(t).epsilon(1e-12));
  const double infinity = std::numeric_limits<double>::infinity();
  CHECK(translation_at(keys, infinity).x() == 2.0);
  CHECK(translation_at(keys, -infinity).x() == 0.0);
  CHECK(translation_at(keys, std::nan("")).x() == 0.0);
}

TEST_CASE("clip: one key is a pose at every time, and two keys at one time are a jump") {
  Keys<Vec3> keys{Interpolation::kLinear, {0.5}, {{3, 0, 0}}};
  for (const double t : {-1.0, 0.0, 0.5, 7.0}) CHECK(translation_at(keys, t).x() == 3.0);
  keys = {Interpolation::kLinear, {0.0, 1.0, 1.0, 2.0}, {{0, 0, 0}, {1, 0, 0}, {5, 0, 0}, {6, 0, 0}}};
  CHECK(translation_at(keys, 0.999).x() == doctest::Approx(0.999));
  CHECK(translation_at(keys, 1.0).x() == 5.0);
  CHECK(translation_at(keys, 1.5).x() == 5.5);
}

TEST_CASE("clip: joint matrices are the products of local transforms down the chain, with scale and shear") {
  bodice::engine::Random random(5);
  const auto number = [&] { return random.uniform() * 2.0 - 1.0; };
  Skeleton skeleton;
  Clip clip{"random", 1.0, {}};
  for (std::int32_t j = 0; j < 12; ++j) {
    Joint joint;
    joint.parent = j == 0 ? -1 : static_cast<std::int32_t>(random.below(static_cast<std::uint64_t>(j)));
    skeleton.joints.push_back(joint);
    Track track;
    track.joint = static_cast<std::uint16_t>(j);
    track.translation = {Interpolation::kLinear, {0.0}, {Vec3(number(), number(), number())}};
    track.rotation = {
        Interpolation::kLinear, {0.0}, {Quaterniond(number(), number(), number(), number()).normalized()}};
    track.scale = {Interpolation::kLinear, {0.0}, {Vec3(1.5 + number(), 1.5 + number(), 1.5 + number())}};
    clip.tracks.push_back(track);
  }
  std::vector<Affine> world(12);
  joint_matrices(skeleton, clip, 0.3, world);
  for (std::size_t j = 0; j < 12; ++j) {
    Eigen::Matrix4d expected = Eigen::Matrix4d::Identity();
    for (std::int32_t at = static_cast<std::int32_t>(j); at >= 0;
         at = skeleton.joints[static_cast<std::size_t>(at)].parent) {
      const Track& track = clip.tracks[static_cast<std::size_t>(at)];
      const Eigen::Affine3d local = Eigen::Translation3d(track.translation.value[0]) *
                                    track.rotation.value[0] * Eigen::Scaling(track.scale.value[0]);
      expected = local.matrix() * expected;
    }
    CHECK((world[j] - expected.topRows<3>()).norm() < 1e-12 * expected.norm());
  }
}
