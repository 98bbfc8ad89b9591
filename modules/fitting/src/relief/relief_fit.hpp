// The tables of the relief tier: how large each is, and what it holds.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "relief/relief_terms.hpp"

namespace bodice::fitting {

/// Tables may use this much together with the ellipsoids.
inline constexpr std::size_t kReliefBytes = 128 * 1024;

/// Texels that keep a proxy of `ellipsoids` within `bytes`; 0 if there is no room for useful tables.
std::size_t texels_within(std::size_t ellipsoids, std::size_t bytes);

/// Equal sides that use up to `texels`.
std::vector<int> equal_sides(std::size_t ellipsoids, std::size_t texels);

/// Sides that use up to `texels` where they lower the error most: #E errors in, #E nodes per side out.
std::vector<int> shared_sides(std::span<const double> error, std::size_t texels);

/// Answers to more samples where the tables stored last leak, none if they do not; `leaks` are samples that
/// leaked before (ascending).
using LookCloser = std::function<ReliefAnswers(std::span<const std::uint32_t> leaks)>;

/// Fills data.relief and data.texels from the answers; returns each ellipsoid's share of the error that is
/// left (shared_sides takes it). Raises the weights of deep samples that would be reported outside and, if
/// `look_closer` is given, joins what it finds to the answers and fits again. Deterministic, parallel.
std::vector<double> fit_tables(const engine::Context& context, ReliefAnswers& answers,
                               std::span<const int> nodes_per_side, int solver_steps,
                               proxy::BodyProxy::Data& data, const LookCloser& look_closer = {});

}  // namespace bodice::fitting
