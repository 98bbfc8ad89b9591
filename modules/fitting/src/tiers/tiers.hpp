// One function a tier: each turns a labeled skin into ellipsoids.
#pragma once

#include <bodice/fitting/fit.hpp>

#include "cluster/refinement.hpp"
#include "cluster/region_tasks.hpp"
#include "cluster/thresholds.hpp"
#include "skin/skin_samples.hpp"

namespace bodice::fitting {

struct Draft {
  proxy::BodyProxy::Data data;
  Thresholds mu;
  bool thresholds_reached = true;
  std::uint32_t parts = kAllParts;  ///< of the regions that were fitted
};

/// The wanted parts, and those that share a region with them.
std::uint32_t fitted_parts(const std::vector<Region>& regions, std::uint32_t wanted);

/// As written: vertices, k-means, enclosing ellipsoids.
engine::Result<Draft> fit_paper(const engine::Context& context, const LabeledSkin& skin,
                                const FitOptions& options, int count);

/// The paper's refinement of every region as a task of its own: to the thresholds if they are given and at
/// most `count` ellipsoids suffice, else to shares of `count`.
engine::Result<std::vector<FittedRegion>> refine_regions(const engine::Context& context, const Items& items,
                                                         const std::vector<Region>& regions,
                                                         const RefineOptions& refine, const Thresholds& mu,
                                                         int count, const FitOptions& options);

/// No leaks: every triangle ends inside one ellipsoid, and what the union then misses inside is added until
/// nothing is.
engine::Result<Draft> fit_solid(const engine::Context& context, const LabeledSkin& skin,
                                const FitOptions& options, int count);

/// The worst E_j by class, and whether the thresholds asked for were reached, into the draft.
void report_thresholds(const std::vector<Region>& regions, const std::vector<FittedRegion>& fitted,
                       const Thresholds& asked, Draft& draft);

/// All ellipsoids optimized together against the exact signed distance, from medial clusters; anytime.
Draft fit_tight(const engine::Context& context, const SkinSource& source, const FitOptions& options,
                int count, double time_budget_s);

}  // namespace bodice::fitting
