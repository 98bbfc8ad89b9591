#include <bodice/engine/clock.hpp>

#include "relief_fit.hpp"
#include "tier_relief.hpp"
#include "tiers.hpp"

namespace bodice::fitting {
namespace {

/// First tables that are usable soon, and say where more texels pay; then those that last.
constexpr std::size_t kFirstNormals = 8000, kNormals = 48000;
constexpr int kFirstPerNormal = 3, kPerNormal = 6;
constexpr int kFirstSteps = 16, kSteps = 30;
/// Of stature: turns most misses of a tenth of a millimetre into hits.
constexpr double kMargin = 0.1e-3 / 1.7;
/// Of stature: finds every hole between ellipsoids that a thumb fits into.
constexpr double kInsideSpacing = 0.010 / 1.7;

}  // namespace

ReliefTables::ReliefTables(const engine::Context& context, const SkinSource& source,
                           proxy::BodyProxy::Data& data)
    : context_(context), skin_(context, source), data_(data) {
  data_.tier = proxy::Tier::kRelief;
  data_.stature_m = source.skin.stature_m;
  data_.frame = source.skin.frame;
  data_.margin_m = kMargin * data_.stature_m;
}

ReliefAnswers ReliefTables::ask(const ReliefSampling& sampling, double spacing_m) const {
  const proxy::ReliefReach reach = proxy::relief_reach(data_.stature_m);
  auto samples = sample_along_normals(context_, skin_, sampling);
  if (spacing_m > 0.0) {
    const auto inside = sample_inside(context_, skin_, spacing_m, reach.in_m);
    samples.insert(samples.end(), inside.begin(), inside.end());
  }
  return find_answers(context_, samples, data_.ellipsoids, reach);
}

void ReliefTables::fit_first(std::size_t bytes) {
  const std::size_t ellipsoids = data_.ellipsoids.size();
  const double reach_m = proxy::relief_reach(data_.stature_m).out_m;
  ReliefAnswers answers = ask({kFirstNormals, kFirstPerNormal, reach_m, 21}, 0.0);
  const auto sides = equal_sides(ellipsoids, texels_within(ellipsoids, bytes));
  error_ = fit_tables(context_, answers, sides, kFirstSteps, data_);
}

void ReliefTables::fit(std::size_t bytes) {
  const double reach_m = proxy::relief_reach(data_.stature_m).out_m;
  if (answers_.weight.empty())
    answers_ = ask({kNormals, kPerNormal, reach_m, 22}, kInsideSpacing * data_.stature_m);
  const auto sides = shared_sides(error_, texels_within(data_.ellipsoids.size(), bytes));
  fit_tables(context_, answers_, sides, kSteps, data_);
}

void add_relief(const engine::Context& context, const SkinSource& source, const FitOptions& options,
                std::int64_t deadline_ns, Draft& draft) {
  if (texels_within(draft.data.ellipsoids.size(), kReliefBytes) == 0) return;
  ReliefTables tables(context, source, draft.data);
  tables.fit_first(kReliefBytes);
  if (options.on_improved)
    if (auto proxy = proxy::BodyProxy::make(draft.data)) options.on_improved(*proxy);
  if (context.clock->now_ns() < deadline_ns) tables.fit(kReliefBytes);
}

}  // namespace bodice::fitting
