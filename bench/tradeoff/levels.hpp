// For each error that a user may accept: the cheapest proxy, the cheapest peer, and the ratio of their costs.
#pragma once

#include <string>

#include <bench_support/table.hpp>

#include "pareto.hpp"

namespace tradeoff {

/// Costs in nanoseconds a particle.
bench::Table levels_by_time(const std::vector<std::string>& names, std::span<const Offer> offers,
                            const std::vector<bool>& ours);
/// Costs in microseconds a frame.
bench::Table levels_by_moving_frame(const std::vector<std::string>& names, std::span<const Offer> offers,
                                    const std::vector<bool>& ours);
/// Costs in kilobytes.
bench::Table levels_by_bytes(const std::vector<std::string>& names, std::span<const Offer> offers,
                             const std::vector<bool>& ours);

}  // namespace tradeoff
