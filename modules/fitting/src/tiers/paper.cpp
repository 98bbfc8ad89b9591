#include <algorithm>

#include "cluster/allocate_ellipsoids.hpp"
#include "cluster/cluster_items.hpp"
#include "cluster/region_tasks.hpp"
#include "tiers/tiers.hpp"

namespace bodice::inline v0_1::fitting {

std::uint32_t fitted_parts(const std::vector<Region>& regions, std::uint32_t parts) {
  std::uint32_t all = 0;
  for (const Region& region : regions)
    if (wanted(region, parts)) all |= region.parts;
  return all;
}

void report_clusters(const std::vector<FittedRegion>& fitted, const Thresholds& given, Draft& draft) {
  Thresholds worst;
  for (const FittedRegion& region : fitted)
    for (std::size_t k = 0; k < region.error_m.size(); ++k) {
      double& mu = body::is_torso(region.ellipsoids[k].part) ? worst.torso_m : worst.limbs_m;
      mu = std::max(mu, region.error_m[k]);
      draft.cluster_error_m.push_back(region.error_m[k]);
    }
  draft.mu = given.given() ? given : worst;
}

engine::Result<std::vector<FittedRegion>> refine_regions(const engine::Context& context,
                                                         const RegionItems& items,
                                                         const RefineOptions& refine, const Thresholds& mu,
                                                         int count, const FitOptions& options) {
  const std::vector<Region>& regions = items.regions;
  RegionTasks tasks{.verb = "refine"};
  tasks.parts = options.parts;
  tasks.on_part = options.on_part;
  tasks.fit = [&](const engine::Context& inner, const Region& region, int share) {
    Refinement refinement(inner, items.all, region, refine);
    refinement.run(region.torso ? mu.torso_m : mu.limbs_m, static_cast<std::size_t>(share));
    FittedRegion fitted;
    for (const Cluster& c : refinement.clusters()) {
      fitted.ellipsoids.push_back({c.ellipsoid, c.part});
      fitted.error_m.push_back(c.error_m);
    }
    return fitted;
  };
  if (mu.given()) {
    // Each region is first refined without a common limit. Only if that takes too many are they allocated.
    tasks.share = [&](const engine::Context&) { return std::vector<int>(regions.size(), count); };
    tasks.on_part = nullptr;
    auto fitted = run_region_tasks(context, regions, tasks);
    if (!fitted) return fitted;
    std::size_t total = 0;
    for (const FittedRegion& f : *fitted) total += f.ellipsoids.size();
    if (total <= static_cast<std::size_t>(count)) {
      for (std::size_t r = 0; options.on_part && r < regions.size(); ++r)
        if (wanted(regions[r], options.parts))
          options.on_part({regions[r].name, regions[r].parts, (*fitted)[r].ellipsoids});
      return fitted;
    }
    tasks.on_part = options.on_part;
  }
  tasks.share = [&](const engine::Context& inner) {
    return allocate_ellipsoids(inner, items.all, regions, count);
  };
  return run_region_tasks(context, regions, tasks);
}

engine::Result<Draft> fit_paper(const engine::Context& context, const LabeledSkin& skin,
                                const FitOptions& options, int count) {
  RegionItems items{.all = vertex_items(skin), .regions = {}};
  items.regions = make_regions(items.all, count);
  RefineOptions refine = refine_options(skin.stature_m);
  refine.reclassify = options.reclassify_points;
  const Thresholds mu{options.mu_torso_m.value_or(0.0), options.mu_limbs_m.value_or(0.0)};
  const auto fitted = refine_regions(context, items, refine, mu, count, options);
  if (!fitted) return fitted.error();
  Draft draft;
  draft.data.tier = proxy::Tier::kPaper;
  draft.parts = fitted_parts(items.regions, options.parts);
  report_clusters(*fitted, mu, draft);
  for (const FittedRegion& f : *fitted)
    draft.data.ellipsoids.insert(draft.data.ellipsoids.end(), f.ellipsoids.begin(), f.ellipsoids.end());
  return draft;
}

}  // namespace bodice::fitting
