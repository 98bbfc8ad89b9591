// Singular values of 3 x 3 matrices, a few hundred nanoseconds each.
#pragma once

#include <Eigen/Core>

namespace bodice::inline v0_1::binding {

/// m = left diag(values) right^T; values fall and are not negative. `left` is a rotation; `right` is one
/// unless m mirrors.
struct Svd3 {
  Eigen::Matrix3d left, right;
  Eigen::Vector3d values;
};

/// Any finite m. The values are right to 1e-8 of the largest.
Svd3 svd3(const Eigen::Matrix3d& m);

}  // namespace bodice::binding
