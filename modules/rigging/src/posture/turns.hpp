// Rotations about the axes of a frame, in degrees.
#pragma once

#include <numbers>

#include <Eigen/Geometry>

#include <bodice/geometry/types.hpp>

namespace bodice::inline v0_1::rigging {

inline geometry::Mat3 about(int axis, double degrees) {
  const double angle_rad = degrees * std::numbers::pi / 180.0;
  return Eigen::AngleAxisd(angle_rad, geometry::Vec3::Unit(axis)).toRotationMatrix();
}
inline geometry::Mat3 about_x(double degrees) {
  return about(0, degrees);
}
inline geometry::Mat3 about_y(double degrees) {
  return about(1, degrees);
}
inline geometry::Mat3 about_z(double degrees) {
  return about(2, degrees);
}

}  // namespace bodice::rigging
