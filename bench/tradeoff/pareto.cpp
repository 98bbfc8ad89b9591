#include "pareto.hpp"

namespace tradeoff {

std::vector<bool> on_front(std::span<const Offer> offers) {
  std::vector<bool> front;
  for (const Offer& mine : offers) {
    bool beaten = !(mine.cost > 0.0);
    for (const Offer& other : offers) {
      const bool no_worse = other.cost <= mine.cost && other.error_mm <= mine.error_mm;
      const bool better = other.cost < mine.cost || other.error_mm < mine.error_mm;
      beaten = beaten || (other.cost > 0.0 && no_worse && better);
    }
    front.push_back(!beaten);
  }
  return front;
}

std::optional<std::size_t> cheapest(std::span<const Offer> offers, const std::vector<bool>& flag, bool wanted,
                                    double level_mm) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < offers.size(); ++i) {
    if (flag[i] != wanted || !(offers[i].cost > 0.0) || offers[i].error_mm > level_mm) continue;
    if (!best || offers[i].cost < offers[*best].cost) best = i;
  }
  return best;
}

}  // namespace tradeoff
