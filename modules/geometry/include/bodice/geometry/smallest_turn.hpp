#pragma once

#include <Eigen/Geometry>

#include <bodice/geometry/types.hpp>

namespace bodice::inline v0_1::geometry {

/// The rotation by the least angle that takes the direction of one vector to that of another, within 1e-7;
/// neither vector may be zero. Opposite vectors have many such rotations, of which one is chosen that depends
/// on `from` alone. Eigen's FromTwoVectors takes 6 s to compile, for a decomposition that only opposite
/// vectors need, and is off by 1e-5 for vectors that are nearly opposite.
Eigen::Quaterniond smallest_turn(const Vec3& from, const Vec3& to);

}  // namespace bodice::geometry
