// Clips that are played again and again: the seam from their end to their start, and laps.

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include <bodice/rig/loop.hpp>
#include <bodice/rig/rig.hpp>

using namespace bodice::rig;
using Eigen::Quaterniond;

namespace {

/// One joint that in a second moves by 2 m along x and turns by a radian about z; nothing leads back.
Clip swing(Interpolation interpolation) {
  Clip clip{"swing", 1.0, {}};
  clip.tracks.resize(1);
  Track& track = clip.tracks[0];
  track.translation = {interpolation, {0.0, 1.0}, {{0, 0, 0}, {2, 0, 0}}};
  if (interpolation == Interpolation::kCubic)
    track.translation.value = {{2, 0, 0}, {0, 0, 0}, {2, 0, 0}, {2, 0, 0}, {2, 0, 0}, {2, 0, 0}};
  const Quaterniond end(Eigen::AngleAxisd(1.0, Vec3::UnitZ()));
  track.rotation = {Interpolation::kLinear, {0.0, 1.0}, {Quaterniond::Identity(), end}};
  track.scale = {Interpolation::kLinear, {0.0, 1.0}, {{1, 1, 1}, {1, 1, 0.001}}};
  return clip;
}

LocalTransform at(const Clip& clip, double time_s) {
  Skeleton skeleton;
  skeleton.joints.resize(1);
  std::vector<LocalTransform> local(1);
  sample(skeleton, clip, time_s, local);
  return local[0];
}

double x_at(const Clip& clip, double time_s) {
  return at(clip, time_s).translation.x();
}
double turn_at(const Clip& clip, double time_s) {
  const Quaterniond turn = at(clip, time_s).rotation;
  return 2.0 * std::atan2(turn.z(), turn.w());
}

}  // namespace

TEST_CASE("loop: a closed clip is the same until its end, and then leads to its start without a jolt") {
  for (const Interpolation interpolation : {Interpolation::kLinear, Interpolation::kCubic}) {
    const Clip loop = close_loop(swing(interpolation), 0.5);
    CHECK(loop.duration_s == 1.5);
    for (const double t : {0.0, 0.3, 0.99, 1.0}) {
      CHECK(x_at(loop, t) == doctest::Approx(2.0 * t));
      CHECK(turn_at(loop, t) == doctest::Approx(t));
    }
    CHECK(std::abs(x_at(loop, 1.5)) < 1e-12);
    CHECK(std::abs(turn_at(loop, 1.5)) < 1e-12);
    constexpr double kStep_s = 1e-3;  // keys of the seam are a sixtieth apart: slopes are nearly those there
    CHECK((x_at(loop, 1.0 + kStep_s) - x_at(loop, 1.0)) / kStep_s == doctest::Approx(2.0).epsilon(0.2));
    CHECK((x_at(loop, 1.5) - x_at(loop, 1.5 - kStep_s)) / kStep_s == doctest::Approx(2.0).epsilon(0.2));
    CHECK((turn_at(loop, 1.0 + kStep_s) - turn_at(loop, 1.0)) / kStep_s == doctest::Approx(1.0).epsilon(0.2));
    for (double t = 1.0; t < 1.5; t += 0.01) {
      CHECK(std::abs(x_at(loop, t) - 1.0) < 1.2);  // a tenth of a second at its velocity beyond either end
      CHECK(std::abs(turn_at(loop, t) - 0.5) < 0.6);
      CHECK(at(loop, t).scale.z() >= 0.001 - 1e-12);
    }
  }
}

TEST_CASE("loop: a seam without a length, and a clip without one, change nothing; step keys hold") {
  Clip clip = swing(Interpolation::kLinear);
  for (const double seam_s : {0.0, -1.0, std::nan("")}) CHECK(close_loop(clip, seam_s).duration_s == 1.0);
  clip.tracks[0].translation.interpolation = Interpolation::kStep;
  CHECK(x_at(close_loop(clip, 0.5), 1.4) == 2.0);
  clip.duration_s = 0.0;
  CHECK(close_loop(clip, 0.5).duration_s == 0.0);
  CHECK(repeat(clip, 0.5).duration_s == 0.0);
}

TEST_CASE("loop: laps show what a loop shows at each time, and end when they should") {
  Skeleton skeleton;
  skeleton.joints.resize(1);
  std::vector<LocalTransform> looped(1);
  for (const Interpolation interpolation :
       {Interpolation::kLinear, Interpolation::kCubic, Interpolation::kStep}) {
    Clip clip = swing(interpolation);
    clip.tracks[0].translation.time_s = {0.25, 0.75};  // held before and after
    if (interpolation == Interpolation::kCubic) clip.tracks[0].translation.time_s = {0.0, 1.0};
    const Clip laps = repeat(clip, 3.6);
    CHECK(laps.duration_s == 3.6);
    CHECK(laps.tracks[0].rotation.time_s.back() == 3.6);
    for (double t = 0.05; t < 3.6; t += 0.1) {
      sample(skeleton, clip, t, looped, Playback::kLoop);
      CHECK((at(laps, t).translation - looped[0].translation).norm() < 1e-9);
      CHECK(at(laps, t).rotation.angularDistance(looped[0].rotation) < 1e-9);
    }
  }
}
