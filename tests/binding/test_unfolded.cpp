// Maps of ellipsoids where joints fold the skin.
#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

#include <Eigen/Geometry>

#include <bodice/geometry/decompositions.hpp>
#include <bodice/rig/skeleton.hpp>

#include "pose/carried_ellipsoid.hpp"

using namespace bodice;
using geometry::Mat3;
using geometry::Vec3;
using proxy::JointMatrix;

namespace {

const Vec3 kCenter(0.1, 1.4, -0.1);

/// Skin of which a share stays and the rest turns about z, as that on top of a shoulder does with a raised
/// arm.
JointMatrix partly_turned(double share, double degrees, double scale) {
  const Mat3 turn = Eigen::AngleAxisd(degrees / 180.0 * std::numbers::pi, Vec3::UnitZ()).toRotationMatrix();
  return rig::affine(scale * ((1.0 - share) * Mat3::Identity() + share * turn), Vec3(0.2, 0.1, 0.0));
}

/// A map that shrinks one axis to a factor, which may be negative, and turns.
JointMatrix shrunk(double factor, double scale) {
  const Mat3 turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  const Mat3 tilt = Eigen::AngleAxisd(1.1, Vec3(-2, 1, 1).normalized()).toRotationMatrix();
  return rig::affine(scale * turn * Vec3(1.0, factor, 0.95).asDiagonal() * tilt, Vec3(0.0, 0.3, -0.2));
}

Vec3 lengths(const JointMatrix& map) {
  return geometry::singular_values(map.leftCols<3>()).values;
}

}  // namespace

TEST_CASE("a folded map keeps half of each length, mirrors nothing, and moves the center as before") {
  for (const double scale : {1e-3, 1.0, 50.0})
    for (double factor = 1.0; factor > -1.0; factor -= 0.01) {
      const JointMatrix map = shrunk(factor, scale);
      const JointMatrix kept = binding::unfolded(map, kCenter, scale);
      CHECK(lengths(kept).minCoeff() > 0.499 * scale);
      CHECK(kept.leftCols<3>().determinant() > 0.0);
      const Vec3 moved = kept.leftCols<3>() * kCenter + kept.col(3);
      CHECK((moved - map.leftCols<3>() * kCenter - map.col(3)).norm() < 1e-12 * scale);
    }
}

TEST_CASE("a map that keeps its volume is left alone to the bit") {
  for (const double degrees : {0.0, 40.0, 90.0, 170.0})
    CHECK(binding::unfolded(partly_turned(1.0, degrees, 2.0), kCenter, 2.0) ==
          partly_turned(1.0, degrees, 2.0));
  CHECK(binding::unfolded(shrunk(0.65, 1.0), kCenter, 1.0) == shrunk(0.65, 1.0));
}

TEST_CASE("a map becomes folded without a jump, and turns inside out without one") {
  Mat3 last = binding::unfolded(shrunk(1.0, 1.0), kCenter, 1.0).leftCols<3>();
  // Beyond the length of another axis, the axis that a mirror image turns over is no longer defined.
  for (double factor = 1.0; factor > -0.9; factor -= 0.005) {
    const Mat3 now = binding::unfolded(shrunk(factor, 1.0), kCenter, 1.0).leftCols<3>();
    REQUIRE((now - last).norm() < 0.02);
    last = now;
  }
}

TEST_CASE("skin of which half turns by up to 170 degrees keeps half of its width") {
  for (double degrees = 0.0; degrees <= 170.0; degrees += 1.0)
    CHECK(lengths(binding::unfolded(partly_turned(0.5, degrees, 1.0), kCenter, 1.0)).minCoeff() > 0.499);
}
