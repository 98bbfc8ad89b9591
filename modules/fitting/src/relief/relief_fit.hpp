// The tables of tier relief: their sizes and their contents.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "relief/relief_terms.hpp"

namespace bodice::inline v0_1::fitting {

/// The most bytes that a proxy takes with its tables.
inline constexpr std::size_t kReliefBytes = 128 * 1024;

/// The most texels for a proxy of `ellipsoids` within `bytes`; 0 if there is no room for useful tables.
std::size_t texels_within(std::size_t ellipsoids, std::size_t bytes);

/// Equal sides for all tables that use up to `texels`.
std::vector<int> equal_sides(std::size_t ellipsoids, std::size_t texels);

/// Sides that use up to `texels` where these lower the error most: #E errors in, #E nodes a side out.
std::vector<int> shared_sides(std::span<const double> error, std::size_t texels);

/// Returns the terms of additional samples where the stored tables leak, none if they do not; `leaks` are the
/// samples that leaked before (ascending).
using MoreTerms = std::function<ReliefTerms(std::span<const std::uint32_t> leaks)>;

/// Fills data.relief and data.texels from the terms, and returns each ellipsoid's share of the remaining
/// error, which shared_sides() takes. It raises the weights of deep samples that would be reported outside.
/// If `more_terms` is given, it joins those terms to `terms` and fits again. Deterministic, parallel.
std::vector<double> fit_tables(const engine::Context& context, ReliefTerms& terms,
                               std::span<const int> nodes_per_side, int solver_steps,
                               proxy::BodyProxy::Data& data, const MoreTerms& more_terms = {});

}  // namespace bodice::fitting
