// The normal equations of one ellipsoid over its samples, in vector code.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/closest_point_batch.hpp"
#include "tight/robust_loss.hpp"

namespace bodice::fitting {

/// One ellipsoid's normal equations: center, log radii, rotation vector.
struct NormalBlock {
  using Matrix = Eigen::Matrix<double, 9, 9>;
  using Vector = Eigen::Matrix<double, 9, 1>;
  Matrix jtj = Matrix::Zero();
  Vector jtr = Vector::Zero();
};

/// Samples of one ellipsoid, structure of arrays; kept between ellipsoids for its memory.
struct BlockSamples {
  std::size_t count = 0;              ///< the arrays have room for more
  std::vector<float> x, y, z;         ///< points
  std::vector<float> target, d;       ///< skin distance, union distance
  std::vector<float> residual;        ///< union distance less skin distance
  std::vector<float> weight;          ///< of the squared residual, from the robust loss
  std::vector<float> wx, wy, wz;      ///< scratch
  std::vector<std::uint32_t> picked;  ///< scratch

  /// Empties it and makes room for `most` samples.
  void start(std::size_t most);
  void add(float px, float py, float pz, float of_skin, float of_union) {
    x[count] = px, y[count] = py, z[count] = pz, target[count] = of_skin, d[count] = of_union;
    ++count;
  }
  /// Fills in residuals and weights.
  void weigh(const TightLoss& loss) {
    fitting::weigh(loss, count, target.data(), d.data(), residual.data(), weight.data());
  }
};

/// Those of 0 .. n - 1 that hold, ascending. Without branches: which ones hold is hard to foretell.
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

/// sum weight j j^T and sum weight r j, with j = d(distance) / d(center, log radii, rotation vector). The
/// foot minimizes the distance, so that its own motion drops out of the derivative (envelope theorem).
NormalBlock normal_block(const geometry::Ellipsoid& ellipsoid, BlockSamples& samples);

}  // namespace bodice::fitting
