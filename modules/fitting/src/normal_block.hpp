// The normal equations of one ellipsoid over its samples, in vector code.
#pragma once

#include <cstddef>
#include <vector>

#include "foot_batch.hpp"

namespace bodice::fitting {

/// One ellipsoid's normal equations: centre, log radii, rotation vector.
struct NormalBlock {
  using Matrix = Eigen::Matrix<double, 9, 9>;
  using Vector = Eigen::Matrix<double, 9, 1>;
  Matrix jtj = Matrix::Zero();
  Vector jtr = Vector::Zero();
};

/// Samples of one ellipsoid, structure of arrays; kept between ellipsoids for its memory.
struct BlockSamples {
  std::size_t count = 0;             ///< the arrays have room for more
  std::vector<float> x, y, z;        ///< points
  std::vector<float> residual;       ///< union distance less skin distance
  std::vector<float> weight;         ///< of the squared residual, from the robust loss
  std::vector<float> d, wx, wy, wz;  ///< scratch

  /// Empties it and makes room for `most` samples.
  void start(std::size_t most);
  void add(float px, float py, float pz, float r, float w) {
    x[count] = px, y[count] = py, z[count] = pz, residual[count] = r, weight[count] = w;
    ++count;
  }
};

/// sum weight j j^T and sum weight r j, with j = d(distance) / d(centre, log radii, rotation vector). The
/// foot minimises the distance, so that its own motion drops out of the derivative (envelope theorem).
NormalBlock normal_block(const geometry::Ellipsoid& ellipsoid, BlockSamples& samples);

}  // namespace bodice::fitting
