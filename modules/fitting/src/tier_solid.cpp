#include <algorithm>
#include <cmath>

#include <bodice/engine/parallel.hpp>
#include <bodice/fitting/mvee.hpp>

#include "interior_grid.hpp"
#include "items.hpp"
#include "tiers.hpp"

namespace bodice::fitting {
namespace {

constexpr double kAnchors = 2500.0;     // interior points that take part in clustering
constexpr double kWitnesses = 16000.0;  // interior points that must end up covered
constexpr int kRepairPasses = 8;

/// The points that a cluster's ellipsoid must hold.
std::vector<Vec3> enclosed_points(const Items& items, const Cluster& cluster) {
  std::vector<Index> ids;
  for (const Index i : cluster.items)
    ids.insert(ids.end(), items.encloses[i].begin(), items.encloses[i].end());
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  std::vector<Vec3> points;
  for (const Index i : ids) points.push_back(items.points[i]);
  return points;
}

/// For each witness outside every ellipsoid: the cluster it is least outside of. Others: clusters.size().
std::vector<std::size_t> uncovered(const engine::Context& context, const std::vector<Vec3>& witnesses,
                                   const std::vector<Cluster>& clusters) {
  std::vector<std::size_t> nearest(witnesses.size(), clusters.size());
  engine::parallel_for(context, witnesses.size(), 512, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      double least = 1e300;
      for (std::size_t k = 0; k < clusters.size(); ++k) {
        const double level = geometry::level(clusters[k].ellipsoid, witnesses[i]);
        if (level < least) least = level, nearest[i] = k;
        if (level <= 1.0) break;
      }
      if (least <= 1.0) nearest[i] = clusters.size();
    }
  });
  return nearest;
}

/// Refits the clusters with the witnesses they should hold, until all are held. True if none is left.
bool cover(const engine::Context& context, const Items& items, const std::vector<Vec3>& witnesses,
           double min_radius_m, std::vector<Cluster>& clusters) {
  std::vector<std::vector<Vec3>> extra(clusters.size());
  for (int pass = 0; pass < kRepairPasses; ++pass) {
    const std::vector<std::size_t> home = uncovered(context, witnesses, clusters);
    std::vector<std::size_t> changed;
    for (std::size_t i = 0; i < home.size(); ++i)
      if (home[i] < clusters.size()) {
        extra[home[i]].push_back(witnesses[i]);
        changed.push_back(home[i]);
      }
    if (changed.empty()) return true;
    std::sort(changed.begin(), changed.end());
    changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
    engine::parallel_for(context, changed.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t c = begin; c < end; ++c) {
        Cluster& cluster = clusters[changed[c]];
        std::vector<Vec3> points = enclosed_points(items, cluster);
        points.insert(points.end(), extra[changed[c]].begin(), extra[changed[c]].end());
        cluster.ellipsoid = mvee(points, {1e-4, min_radius_m}).ellipsoid;
      }
    });
  }
  return false;
}

}  // namespace

Draft fit_solid(const engine::Context& context, const LabelledSkin& skin, const FitOptions& options,
                int count) {
  const double volume = std::abs(geometry::signed_volume(skin.mesh));
  const bool all_parts = options.parts == (1u << body::kPartCount) - 1;
  const Items items =
      solid_items(skin, options.parts, interior_grid(skin.mesh, std::cbrt(volume / kAnchors)));
  const RefineOptions refine{.sigma_m = 2e-3 * skin.stature_m, .min_radius_m = 3e-4 * skin.stature_m};
  const Thresholds mu{options.mu_torso_m.value_or(0.0), options.mu_limbs_m.value_or(0.0)};
  const Allocation done =
      allocate(context, items, make_regions(items), refine, mu, static_cast<std::size_t>(count));
  std::vector<Cluster> clusters = done.clusters();
  // A body of some parts only has no inside of its own: its anchors are what it covers.
  const std::vector<Vec3> witnesses =
      all_parts ? interior_grid(skin.mesh, std::cbrt(volume / kWitnesses)) : std::vector<Vec3>{};
  cover(context, items, witnesses, refine.min_radius_m, clusters);
  Draft draft;
  draft.data.tier = proxy::Tier::kSolid;
  draft.mu = done.in_force;
  draft.thresholds_reached = done.reached;
  for (const Cluster& c : clusters) draft.data.ellipsoids.push_back({c.ellipsoid, c.part});
  return draft;
}

}  // namespace bodice::fitting
