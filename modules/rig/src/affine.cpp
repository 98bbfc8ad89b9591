#include <bodice/rig/affine.hpp>

#include <cmath>

#include "tolerances.hpp"

namespace bodice::inline v0_1::rig {

bool is_invertible(const Affine& map) {
  if (!map.allFinite()) return false;
  const Mat3 linear = linear_of(map);
  const double lengths = linear.col(0).norm() * linear.col(1).norm() * linear.col(2).norm();
  return std::isnormal(lengths) && std::abs(linear.determinant()) > kSingular * lengths;
}

}  // namespace bodice::rig
