#include "tight/robust_loss.hpp"

#include "base/vector_clones.hpp"

namespace bodice::inline v0_1::fitting {

BODICE_CLONES void count_costs(const RobustLoss& counted, std::size_t n, const float* __restrict target,
                               const std::uint8_t* __restrict one_sided, const float* __restrict d,
                               float* __restrict cost) {
  const RobustLoss loss = counted;
  for (std::size_t i = 0; i < n; ++i) cost[i] = loss.cost(target[i], one_sided[i] != 0, d[i]);
}

BODICE_CLONES void weigh(const RobustLoss& counted, std::size_t n, const float* __restrict target,
                         const float* __restrict d, float* __restrict residual, float* __restrict weight) {
  const RobustLoss loss = counted;
  for (std::size_t i = 0; i < n; ++i) {
    residual[i] = d[i] - target[i];
    weight[i] = loss.weight(target[i], d[i]);
  }
}

}  // namespace bodice::fitting
