#include "relief/relief_fit.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include <bodice/engine/parallel.hpp>

#include "relief/relief_system.hpp"

namespace bodice::inline v0_1::fitting {
namespace {

using Vector = ReliefSystem::Vector;

constexpr int kLeastSide = 4, kMostSide = 96;  // nodes along a side of a table
/// A leak is a sample deeper than the first fraction of stature that is reported less deep than the rest of
/// the depth beyond the second. Particles there would be pushed to the wrong side.
constexpr double kLeakDepth = 7e-3 / 1.7, kLeakMargin = 6e-3 / 1.7;
constexpr float kLeakFactor = 20.0f;  // a leak weighs so many times more in the next solution
constexpr int kLeakRounds = 4, kStepsAfterWeights = 5;  // solutions after raised weights, and their steps
constexpr int kMostExtensions = 2;                      // rounds in which samples around leaks are added
constexpr double kLeastWeight = 0.05;  // a node with less weight does not count for the range of a table

std::size_t square(int side) {
  return static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
}

/// The values that a byte can represent: offset + scale * byte / 255.
struct Range {
  float offset = 0.0f, scale = 0.0f;

  std::uint8_t byte(double value) const {
    if (!(scale > 0.0f)) return 0;
    const double b = (value - static_cast<double>(offset)) / static_cast<double>(scale) * 255.0;
    return static_cast<std::uint8_t>(std::lround(std::clamp(b, 0.0, 255.0)));
  }
};

/// The range of the values that samples determine; other values are clamped into it.
Range range_of(std::span<const double> values, std::span<const double> weight) {
  double low = 0.0, high = 0.0;
  bool any = false;
  for (std::size_t u = 0; u < values.size(); ++u) {
    if (!(weight[u] > kLeastWeight)) continue;
    low = any ? std::min(low, values[u]) : values[u];
    high = any ? std::max(high, values[u]) : values[u];
    any = true;
  }
  return {static_cast<float>(low), static_cast<float>(high - low)};
}

void store_table(const ReliefSystem& system, const ReliefSystem::Vector& x, std::size_t k,
                 proxy::ReliefTable& table, std::span<proxy::ReliefTexel> texels) {
  const auto h = system.h(x, k), a = system.a(x, k), weight = system.weight(k);
  const Range h_range = range_of(h, weight), a_range = range_of(a, weight);
  table.h_offset_m = h_range.offset;
  table.h_scale_m = h_range.scale;
  table.a_offset = a_range.offset;
  table.a_scale = a_range.scale;
  const auto& unknown_of = system.grid(k).unknown_of;
  for (std::size_t node = 0; node < unknown_of.size(); ++node)
    texels[node] = {h_range.byte(h[unknown_of[node]]), a_range.byte(a[unknown_of[node]])};
}

void store_tables(const engine::Context& context, const ReliefSystem& system, const ReliefSystem::Vector& x,
                  std::span<const int> nodes_per_side, proxy::BodyProxy::Data& data) {
  data.relief.assign(nodes_per_side.size(), {});
  std::size_t texels = 0;
  for (std::size_t k = 0; k < nodes_per_side.size(); ++k) {
    data.relief[k].nodes_per_side = static_cast<std::uint16_t>(nodes_per_side[k]);
    data.relief[k].first_texel = static_cast<std::uint32_t>(texels);
    texels += square(nodes_per_side[k]);
  }
  data.texels.assign(texels, {});
  engine::parallel_for(context, data.relief.size(), 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k)
      store_table(system, x, k, data.relief[k],
                  std::span(data.texels).subspan(data.relief[k].first_texel, square(nodes_per_side[k])));
  });
}

/// Raises the weights of leaks: deep samples that the tables would report outside, or nearly. Returns their
/// indices.
std::vector<std::uint32_t> raise_leaks(const ReliefSystem& system, const ReliefSystem::Vector& x,
                                       double stature_m, ReliefTerms& terms) {
  const std::vector<double> error = system.errors(x);
  std::vector<std::uint32_t> leaks;
  for (std::size_t i = 0; i < error.size(); ++i) {
    const double s = terms.signed_distance_m[i];
    const bool has_terms = terms.of_begin[i] < terms.of_begin[i + 1];
    if (!has_terms || s > -kLeakDepth * stature_m || s + error[i] < -kLeakMargin * stature_m) continue;
    terms.weight[i] *= kLeakFactor;
    leaks.push_back(static_cast<std::uint32_t>(i));
  }
  return leaks;
}

/// Raises the weights of leaks and solves again until none is left, at most kLeakRounds times. Returns the
/// leaks of the first round.
std::vector<std::uint32_t> close_leaks(const ReliefSystem& system, const ReliefSystem::Vector& free,
                                       double stature_m, ReliefTerms& terms, ReliefSystem::Vector& x) {
  std::vector<std::uint32_t> first;
  for (int round = 0; round < kLeakRounds; ++round) {
    auto leaks = raise_leaks(system, x, stature_m, terms);
    if (leaks.empty()) break;
    if (round == 0) first = std::move(leaks);
    x = system.solve(std::move(x), kStepsAfterWeights, free);
  }
  return first;
}

}  // namespace

std::size_t texels_within(std::size_t ellipsoids, std::size_t bytes) {
  constexpr std::size_t kBytesEach = 15 * sizeof(float) + sizeof(proxy::ReliefTable);
  const std::size_t used = ellipsoids * kBytesEach;
  if (ellipsoids == 0 || used >= bytes) return 0;
  const std::size_t texels = (bytes - used) / sizeof(proxy::ReliefTexel);
  return texels < ellipsoids * square(kLeastSide) ? 0 : texels;
}

std::vector<int> equal_sides(std::size_t ellipsoids, std::size_t texels) {
  const double each = static_cast<double>(texels) / static_cast<double>(std::max<std::size_t>(1, ellipsoids));
  return std::vector<int>(ellipsoids, std::clamp(static_cast<int>(std::sqrt(each)), kLeastSide, kMostSide));
}

// The error of an ellipsoid with a table of side N falls about as c / N. The least sum of c / N for a given
// sum of N^2 has the same c / N^3 for all. As the errors were found with equal sides, c is proportional to
// the error.
std::vector<int> shared_sides(std::span<const double> error, std::size_t texels) {
  std::vector<double> wanted;
  double squares = 0.0;
  for (const double e : error) {
    wanted.push_back(std::cbrt(std::max(e, 1e-9)));
    squares += wanted.back() * wanted.back();
  }
  const double scale = std::sqrt(static_cast<double>(texels) / std::max(squares, 1e-30));
  std::vector<int> sides;
  std::size_t used = 0;
  for (const double w : wanted) {
    sides.push_back(std::clamp(static_cast<int>(std::lround(scale * w)), 2 * kLeastSide, kMostSide));
    used += square(sides.back());
  }
  while (used > texels) {  // rounding and the limits exceeded the sum: the largest sides are reduced
    int& largest = *std::max_element(sides.begin(), sides.end());
    if (largest <= kLeastSide) break;
    used -= square(largest) - square(largest - 1);
    --largest;
  }
  return sides;
}

std::vector<double> fit_tables(const engine::Context& context, ReliefTerms& terms,
                               std::span<const int> nodes_per_side, int solver_steps,
                               proxy::BodyProxy::Data& data, const MoreTerms& more_terms) {
  auto system = std::make_unique<ReliefSystem>(context, terms, nodes_per_side);
  const auto unknowns = system->unknowns();
  Vector x = system->solve(Vector::Zero(unknowns), solver_steps, Vector::Ones(unknowns));
  // The limit beyond which the corrected distance would fall while a point moves outward.
  const Vector free = system->limit_slopes(x, proxy::relief_reach(data.stature_m).out_m);
  x = system->solve(std::move(x), kStepsAfterWeights, free);
  std::vector<std::uint32_t> leaks = close_leaks(*system, free, data.stature_m, terms, x);
  store_tables(context, *system, x, nodes_per_side, data);
  for (int round = 0; round < kMostExtensions && more_terms; ++round) {
    const ReliefTerms more = more_terms(leaks);
    if (more.target_m.empty()) break;
    terms = joined(terms, more);
    system = std::make_unique<ReliefSystem>(context, terms, nodes_per_side);
    x = system->solve(std::move(x), kStepsAfterWeights, free);
    leaks = close_leaks(*system, free, data.stature_m, terms, x);
    store_tables(context, *system, x, nodes_per_side, data);
  }
  return system->error_of_each(x);
}

}  // namespace bodice::fitting
