#include "allocate.hpp"

#include <algorithm>

#include <bodice/engine/parallel.hpp>

namespace bodice::fitting {
namespace {

/// How urgent a region's next split is; above 1 its threshold is not met.
double urgency(const Refinement& region, const Thresholds& thresholds) {
  const bool torso = region.region().torso;
  const double mu = torso ? thresholds.torso_m : thresholds.limbs_m;
  return region.worst_error() / mu;
}

Thresholds remaining(const std::vector<Refinement>& regions) {
  Thresholds worst;
  for (const Refinement& r : regions) {
    double& mu = r.region().torso ? worst.torso_m : worst.limbs_m;
    for (const Cluster& c : r.clusters()) mu = std::max(mu, c.error_m);
  }
  return worst;
}

}  // namespace

std::size_t Allocation::count() const {
  std::size_t n = 0;
  for (const Refinement& r : regions) n += r.clusters().size();
  return n;
}

std::vector<Cluster> Allocation::clusters() const {
  std::vector<Cluster> all;
  for (const Refinement& r : regions) all.insert(all.end(), r.clusters().begin(), r.clusters().end());
  return all;
}

Allocation allocate(const engine::Context& context, const Items& items, std::vector<Region> regions,
                    const RefineOptions& options, const Thresholds& thresholds, std::size_t max_count) {
  Allocation result;
  const bool by_count = !(thresholds.torso_m > 0.0) || !(thresholds.limbs_m > 0.0);
  const Thresholds scale = by_count ? Thresholds{kTorsoToLimbs, 1.0} : thresholds;
  for (Region& region : regions) {
    // Few ellipsoids asked for: the torso starts as one cluster instead of six.
    if (max_count < 20 && region.seeds.size() > 1) region.seeds.resize(1);
    result.regions.emplace_back(context, items, std::move(region), options);
  }
  // Every split either adds an ellipsoid or leaves a region that cannot be split: bounded by the items.
  for (std::size_t guard = 0; guard < items.where.size() && result.count() < max_count; ++guard) {
    std::size_t worst = 0;
    for (std::size_t r = 1; r < result.regions.size(); ++r)
      if (urgency(result.regions[r], scale) > urgency(result.regions[worst], scale)) worst = r;
    const double most = result.regions.empty() ? 0.0 : urgency(result.regions[worst], scale);
    if (!(most > (by_count ? 0.0 : 1.0))) break;
    context.cancel.check();
    result.regions[worst].split_worst();
  }
  result.in_force = by_count ? remaining(result.regions) : thresholds;
  if (!by_count)
    for (const Refinement& r : result.regions)
      for (const Cluster& c : r.clusters())
        if (c.error_m > (r.region().torso ? thresholds.torso_m : thresholds.limbs_m)) result.reached = false;
  return result;
}

}  // namespace bodice::fitting
