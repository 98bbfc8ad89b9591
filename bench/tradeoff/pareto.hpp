// Which settings nobody beats in both cost and error, and who is nearest at a given error.
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace tradeoff {

struct Offer {
  double cost = 0.0;  ///< 0: not known, takes no part
  double error_mm = 0.0;
};

/// One flag an offer: no other one costs less at no more error.
std::vector<bool> on_front(std::span<const Offer> offers);

/// The cheapest of those with `flag[i] == wanted` whose error is at most the level; nothing if none is.
std::optional<std::size_t> cheapest(std::span<const Offer> offers, const std::vector<bool>& flag, bool wanted,
                                    double level_mm);

}  // namespace tradeoff
