#include "items.hpp"
#include "tiers.hpp"

namespace bodice::fitting {

Draft fit_paper(const engine::Context& context, const LabelledSkin& skin, const FitOptions& options,
                int count) {
  const Items items = vertex_items(skin, options.parts);
  // Pruned stop: centres that move less than this no longer change which ellipsoid fits best.
  const RefineOptions refine{.sigma_m = 2e-3 * skin.stature_m,
                             .min_radius_m = 3e-4 * skin.stature_m,
                             .reclassify = options.reclassify_points};
  const Thresholds mu{options.mu_torso_m.value_or(0.0), options.mu_limbs_m.value_or(0.0)};
  const Allocation done =
      allocate(context, items, make_regions(items), refine, mu, static_cast<std::size_t>(count));
  Draft draft;
  draft.data.tier = proxy::Tier::kPaper;
  draft.mu = done.in_force;
  draft.thresholds_reached = done.reached;
  for (const Cluster& c : done.clusters()) draft.data.ellipsoids.push_back({c.ellipsoid, c.part});
  return draft;
}

}  // namespace bodice::fitting
