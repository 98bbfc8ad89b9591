#include <algorithm>

#include <bodice/engine/clock.hpp>

#include "relief_fit.hpp"
#include "tiers.hpp"

namespace bodice::fitting {
namespace {

/// First a table that is usable soon, then the one that lasts.
constexpr std::size_t kFirstSamples = 24000;
constexpr std::size_t kSamples = 120000;
constexpr double kMargin =
    0.1e-3 / 1.7;  // of stature: turns most misses of a tenth of a millimetre into hits

std::vector<DistanceSample> samples_for(const engine::Context& context, const SkinSource& source,
                                        std::size_t count, std::uint64_t seed) {
  const double mm = 1e-3 * source.skin.stature_m / 1.7;
  return sample_near_skin(context, source, {count, 30 * mm, 32 * mm, 0.3, 0.0, 0.0, seed});
}

}  // namespace

void add_relief(const engine::Context& context, const SkinSource& source, const FitOptions& options,
                std::int64_t deadline_ns, Draft& draft) {
  const LabelledSkin& skin = source.skin;
  const int nodes = relief_nodes_per_side(draft.data.ellipsoids.size());
  if (nodes == 0) return;
  draft.data.tier = proxy::Tier::kRelief;
  draft.data.stature_m = skin.stature_m;
  draft.data.frame = skin.frame;
  draft.data.margin_m = kMargin * skin.stature_m;
  std::vector<DistanceSample> samples = samples_for(context, source, kFirstSamples, 21);
  fit_relief(context, samples, nodes, draft.data);
  if (options.on_improved)
    if (auto proxy = proxy::BodyProxy::make(draft.data)) options.on_improved(*proxy);
  if (context.clock->now_ns() >= deadline_ns) return;
  const auto more = samples_for(context, source, kSamples - kFirstSamples, 22);
  samples.insert(samples.end(), more.begin(), more.end());
  fit_relief(context, samples, nodes, draft.data);
}

}  // namespace bodice::fitting
