// One function a tier: each turns a labeled skin into ellipsoids.
#pragma once

#include <bodice/fitting/fit.hpp>

#include "cluster/refinement.hpp"
#include "cluster/region_tasks.hpp"
#include "cluster/thresholds.hpp"
#include "skin/skin_samples.hpp"

namespace bodice::inline v0_1::fitting {

/// A time budget that no fit reaches, seconds.
inline constexpr double kNoTimeLimit_s = 1e6;

/// What a tier makes of a skin.
struct Draft {
  proxy::BodyProxy::Data data;
  Thresholds mu;                        ///< in force; zeros for tiers without clusters
  std::vector<double> cluster_error_m;  ///< E_j, one an ellipsoid; empty for tiers without clusters
  std::uint32_t parts = kAllParts;      ///< a bit for each part of the fitted regions
};

/// The items of a skin, and the regions that they form.
struct RegionItems {
  Items all;
  std::vector<Region> regions;  ///< of indices into `all`
};

/// The wanted parts and the parts that share a region with them.
std::uint32_t fitted_parts(const std::vector<Region>& regions, std::uint32_t wanted);

/// Tier paper, as published: vertices, K-means, enclosing ellipsoids.
engine::Result<Draft> fit_paper(const engine::Context& context, const LabeledSkin& skin,
                                const FitOptions& options, int count);

/// Refines every region as the paper does, in a task of its own: to the thresholds if they are given and at
/// most `count` ellipsoids suffice for that, else to each region's share of `count`.
engine::Result<std::vector<FittedRegion>> refine_regions(const engine::Context& context,
                                                         const RegionItems& items,
                                                         const RefineOptions& refine, const Thresholds& mu,
                                                         int count, const FitOptions& options);

/// Tier solid, without leaks: every triangle ends inside one ellipsoid, then ellipsoids grow until the union
/// holds the interior.
engine::Result<Draft> fit_solid(const engine::Context& context, const LabeledSkin& skin,
                                const FitOptions& options, int count);

/// Notes every E_j in the draft, and the thresholds in force: the given ones, else the largest E_j of the
/// torso's and of the limbs' ellipsoids.
void report_clusters(const std::vector<FittedRegion>& fitted, const Thresholds& given, Draft& draft);

/// Tier tight: optimizes all ellipsoids together against the exact signed distance, from medial clusters. It
/// is an anytime task: it ends after `time_budget_s` with what it has.
Draft fit_tight(const engine::Context& context, const SkinSource& source, const FitOptions& options,
                int count, double time_budget_s);

}  // namespace bodice::fitting
