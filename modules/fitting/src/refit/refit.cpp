#include <bodice/fitting/refit.hpp>

#include <algorithm>
#include <cmath>

#include <bodice/engine/catch_canceled.hpp>
#include <bodice/engine/parallel.hpp>

#include "refit/posed_terms.hpp"
#include "relief/relief_system.hpp"

namespace bodice::inline v0_1::fitting {
namespace {

/// Skin points and samples a point: fewer than for tables from nothing, since only what changed is solved.
constexpr std::size_t kRefitNormals = 14000;
constexpr int kRefitPerNormal = 4;
constexpr int kRefitSteps = 10, kRefitStepsAfterWeights = 3;
/// A node with less weight was determined by no sample; its values do not count for the range of a table.
constexpr double kLeastRefitWeight = 0.05;

using Vector = ReliefSystem::Vector;

engine::Error refused(std::string what) {
  return {engine::ErrorCode::kInvalidArgument, "Refit: " + std::move(what) + ".",
          "Refit a bound proxy of tier relief in a pose of its own."};
}

/// The values of the tables at rest, as unknowns.
Vector values_at_rest(const ReliefSystem& system, const proxy::BodyProxy& rest) {
  Vector x = Vector::Zero(system.unknowns());
  for (std::size_t k = 0; k < rest.relief().size(); ++k) {
    const proxy::ReliefTable& table = rest.relief()[k];
    double* const h = x.data() + system.first(k);
    double* const a = h + system.grid(k).unknowns;
    const auto& unknown_of = system.grid(k).unknown_of;
    for (std::size_t node = 0; node < unknown_of.size(); ++node) {
      const proxy::ReliefTexel texel = rest.texels()[table.first_texel + node];
      h[unknown_of[node]] = double{table.h_offset_m} + double{table.h_scale_m} * texel.h / 255.0;
      a[unknown_of[node]] = double{table.a_offset} + double{table.a_scale} * texel.a / 255.0;
    }
  }
  return x;
}

/// One for each unknown that may change, else zero.
Vector free_unknowns(const ReliefSystem& system, const RefitInput& input) {
  Vector free = Vector::Ones(system.unknowns());
  for (std::size_t k = 0; k < input.shapes.size(); ++k)
    if (!input.tables.is_free(static_cast<std::uint32_t>(k)))
      free.segment(static_cast<Eigen::Index>(system.first(k)), 2 * system.grid(k).unknowns).setZero();
  return free;
}

/// The values that a byte can hold: low + size * byte / 255.
struct RefitRange {
  double low = 0.0, size = 0.0;

  std::uint8_t byte(double value) const {
    if (!(size > 0.0)) return 0;
    return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp((value - low) / size, 0.0, 1.0)));
  }
};

/// The range at rest, with the values that samples determined.
RefitRange range_of(double low, double size, std::span<const double> values, std::span<const double> weight,
                    double most) {
  double high = low + size;
  for (std::size_t u = 0; u < values.size(); ++u) {
    if (!(weight[u] > kLeastRefitWeight)) continue;
    low = std::min(low, std::max(values[u], -most));
    high = std::max(high, std::min(values[u], most));
  }
  return {low, high - low};
}

void store(const ReliefSystem& system, const Vector& x, std::size_t k, double most_m, RefitTables& tables) {
  proxy::ReliefTable& table = tables.relief[k];
  const auto h = system.h(x, k), a = system.a(x, k), weight = system.weight(k);
  const RefitRange h_range = range_of(double{table.h_offset_m}, double{table.h_scale_m}, h, weight, most_m);
  const RefitRange a_range = range_of(double{table.a_offset}, double{table.a_scale}, a, weight, most_m);
  table.h_offset_m = static_cast<float>(h_range.low);
  table.h_scale_m = static_cast<float>(h_range.size);
  table.a_offset = static_cast<float>(a_range.low);
  table.a_scale = static_cast<float>(a_range.size);
  const auto& unknown_of = system.grid(k).unknown_of;
  for (std::size_t node = 0; node < unknown_of.size(); ++node)
    tables.texels[table.first_texel + node] = {h_range.byte(h[unknown_of[node]]),
                                               a_range.byte(a[unknown_of[node]])};
}

RefitTables solved(const engine::Context& context, const LabeledSkin& posed, const RefitInput& input) {
  const proxy::BodyProxy& rest = input.rest;
  const double reach_m = proxy::relief_reach(rest.stature_m() * input.scale).out_m;
  const SkinSource source = make_skin_source(context, posed, kAllParts);
  const FreeSkin skin(context, source);
  const auto samples = sample_along_normals(context, skin, {kRefitNormals, kRefitPerNormal, reach_m, 23});
  ReliefTerms terms = find_posed_terms(context, samples, input);
  std::vector<int> sides;
  for (const proxy::ReliefTable& table : rest.relief()) sides.push_back(table.nodes_per_side);
  const ReliefSystem system(context, terms, sides);
  // What is solved for are the corrections, so that a table keeps what no sample determines.
  const Vector before = values_at_rest(system, rest);
  terms.target_m = system.errors(before);
  const Vector free = free_unknowns(system, input);
  Vector x = system.solve(Vector::Zero(system.unknowns()), kRefitSteps, free);
  const double limit_m = proxy::relief_reach(rest.stature_m()).out_m;
  Vector all = before + x;
  const Vector unlimited = system.limit_slopes(all, limit_m);
  x = system.solve(all - before, kRefitStepsAfterWeights, free.cwiseProduct(unlimited));
  all = before + x;
  RefitTables tables{{rest.relief().begin(), rest.relief().end()},
                     {rest.texels().begin(), rest.texels().end()}};
  engine::parallel_for(context, tables.relief.size(), 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k)
      if (input.tables.is_free(static_cast<std::uint32_t>(k))) store(system, all, k, limit_m, tables);
  });
  return tables;
}

}  // namespace

engine::Result<RefitTables> refit_tables(const engine::Context& context, const LabeledSkin& posed,
                                         const RefitInput& input) {
  if (input.rest.relief().empty()) return refused("the proxy has no tables");
  if (input.shapes.size() != input.rest.ellipsoids().size())
    return refused("the pose has another number of ellipsoids than the proxy");
  return engine::catch_canceled(
      "The refit", [&]() -> engine::Result<RefitTables> { return solved(context, posed, input); });
}

}  // namespace bodice::fitting
