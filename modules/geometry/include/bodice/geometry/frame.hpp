#pragma once

#include <bodice/geometry/types.hpp>

namespace bodice::inline v0_1::geometry {

/// A coordinate axis of a file.
enum class Axis : std::uint8_t { kX, kY, kZ };

/// The unit and up axis of a file. They relate its coordinates to those of bodice (meters, y up):
/// inside = meters_per_unit * rotation(up) * file. Rotations are signed permutations, hence exact.
struct Frame {
  double meters_per_unit = 1.0;
  Axis up = Axis::kY;

  /// The rotation from the file's axes to y up.
  Mat3 rotation() const {
    Mat3 r = Mat3::Identity();
    if (up == Axis::kZ) r << 1, 0, 0, 0, 0, 1, 0, -1, 0;
    if (up == Axis::kX) r << 0, -1, 0, 1, 0, 0, 0, 0, 1;
    return r;
  }
  /// A point of the file in meters, y up.
  Vec3 to_inside(const Vec3& file_point) const { return meters_per_unit * (rotation() * file_point); }
  /// The inverse of to_inside().
  Vec3 to_file(const Vec3& inside_point) const {
    return rotation().transpose() * inside_point / meters_per_unit;
  }
  /// A direction in the file's axes; its length stays.
  Vec3 direction_to_file(const Vec3& inside) const { return rotation().transpose() * inside; }
};

}  // namespace bodice::geometry
