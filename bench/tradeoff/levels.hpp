// At each error that a user may settle for: our cheapest setting, the nearest rival, and the ratio.
#pragma once

#include <string>

#include <bench_support/table.hpp>

#include "pareto.hpp"

namespace tradeoff {

bench::Table levels_by_time(const std::vector<std::string>& names, std::span<const Offer> offers,
                            const std::vector<bool>& ours);
/// Costs in microseconds.
bench::Table levels_by_moving_frame(const std::vector<std::string>& names, std::span<const Offer> offers,
                                    const std::vector<bool>& ours);
bench::Table levels_by_bytes(const std::vector<std::string>& names, std::span<const Offer> offers,
                             const std::vector<bool>& ours);

}  // namespace tradeoff
