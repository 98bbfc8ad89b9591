#pragma once

#include <string>
#include <vector>

#include <bodice/fitting/fit.hpp>

#include <bench_references/near_skin.hpp>

namespace fit_bench {

/// One row a proxy that an anytime tier publishes: milliseconds since the fit began and its error near the
/// skin. The last row says after how long half of the gain over the start was there (the bar for tight: 100
/// ms). False if a fit fails.
bool print_anytime(const bodice::engine::Context& context, const std::string& name,
                   const bodice::fitting::LabeledSkin& skin, const std::vector<bench::Probe>& probes,
                   bodice::proxy::Tier tier);

}  // namespace fit_bench
