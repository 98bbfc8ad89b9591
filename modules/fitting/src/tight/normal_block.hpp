// The normal equations of one ellipsoid over its samples, in vector code.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/closest_point_batch.hpp"
#include "tight/robust_loss.hpp"

namespace bodice::inline v0_1::fitting {

/// One ellipsoid's normal equations for 9 unknowns: center, log radii, rotation vector.
struct NormalBlock {
  using Matrix = Eigen::Matrix<double, 9, 9>;
  using Vector = Eigen::Matrix<double, 9, 1>;
  Matrix jtj = Matrix::Zero();
  Vector jtr = Vector::Zero();
};

/// The samples of one ellipsoid, structure of arrays. Reuse the object, because it keeps its memory.
struct BlockSamples {
  std::size_t count = 0;              ///< number of samples; the arrays may be longer
  std::vector<float> x, y, z;         ///< points
  std::vector<float> target, d;       ///< distance to the skin, distance to the union
  std::vector<float> residual;        ///< d - target
  std::vector<float> weight;          ///< weight of the squared residual, from the robust loss
  std::vector<float> wx, wy, wz;      ///< scratch: directions of the closest points
  std::vector<std::uint32_t> picked;  ///< scratch

  /// Removes all samples and makes room for `most`.
  void start(std::size_t most);
  void add(float px, float py, float pz, float of_skin, float of_union) {
    x[count] = px, y[count] = py, z[count] = pz, target[count] = of_skin, d[count] = of_union;
    ++count;
  }
  /// Fills in residuals and weights.
  void weigh(const RobustLoss& loss) {
    fitting::weigh(loss, count, target.data(), d.data(), residual.data(), weight.data());
  }
};

/// The indices in 0 .. n - 1 for which `holds` is true, ascending. It has no branches, because they would be
/// hard to predict.
template <class Holds>
std::span<const std::uint32_t> pick(std::size_t n, std::vector<std::uint32_t>& room, const Holds& holds) {
  if (room.size() < n + 1) room.resize(n + 1);
  std::size_t count = 0;
  for (std::size_t i = 0; i < n; ++i) {
    room[count] = static_cast<std::uint32_t>(i);
    count += holds(i) ? 1u : 0u;
  }
  return {room.data(), count};
}

/// Sums weight j j^T and weight r j over the samples, with r the residual and j the derivative of the
/// distance by center, log radii and rotation vector. The closest point minimizes the distance, so that its
/// own motion drops out of the derivative (envelope theorem).
NormalBlock normal_block(const geometry::Ellipsoid& ellipsoid, BlockSamples& samples);

}  // namespace bodice::fitting
