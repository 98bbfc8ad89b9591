#pragma once

#include <bodice/geometry/types.hpp>

namespace bodice::inline v0_1::io {

/// Whether a box is so far from the origin that floats would lose over 1e-5 of its diagonal: by over 16
/// diagonals.
inline bool is_far_from_origin(const geometry::Box& box) {
  constexpr double kFarDiagonals = 16.0;
  return !box.empty() && box.center().norm() > kFarDiagonals * box.size().norm();
}

}  // namespace bodice::io
