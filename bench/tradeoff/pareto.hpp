// The Pareto front of cost and error, and the cheapest offer at a given error.
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace tradeoff {

/// The cost and the error of one setting.
struct Offer {
  double cost = 0.0;  ///< 0: the cost is not known, and the offer does not count
  double error_mm = 0.0;
};

/// One flag an offer: whether no other offer is better in cost or error and at least as good in both.
std::vector<bool> on_front(std::span<const Offer> offers);

/// The cheapest of the offers with `flag[i] == wanted` and an error of at most `level_mm`, if there is one.
std::optional<std::size_t> cheapest(std::span<const Offer> offers, const std::vector<bool>& flag, bool wanted,
                                    double level_mm);

}  // namespace tradeoff
