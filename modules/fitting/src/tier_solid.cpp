#include <algorithm>
#include <cmath>

#include <bodice/engine/parallel.hpp>
#include <bodice/fitting/mvee.hpp>

#include "interior_grid.hpp"
#include "items.hpp"
#include "medial_start.hpp"
#include "scaling.hpp"
#include "tiers.hpp"
#include "tight_descent.hpp"

namespace bodice::fitting {
namespace {

constexpr double kAnchors = 2500.0;     // interior points that take part in clustering
constexpr double kWitnesses = 40000.0;  // interior points that must end up covered
constexpr int kRepairPasses = 8;
constexpr double kMinRadius = 3e-4;  // of stature
constexpr int kCoveringIterations = 30;

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

/// By thresholds: bisecting refinement over triangles and interior points.
Allocation clusters_by_threshold(const engine::Context& context, const Items& items, const LabelledSkin& skin,
                                 const FitOptions& options, int count) {
  const RefineOptions refine{.sigma_m = 2e-3 * skin.stature_m, .min_radius_m = kMinRadius * skin.stature_m};
  return allocate(context, items, make_regions(items), refine, {*options.mu_torso_m, *options.mu_limbs_m},
                  static_cast<std::size_t>(count));
}

/// By count: a short descent says where the ellipsoids should be; each item goes to the one that holds it
/// best.
std::vector<geometry::Ellipsoid> covering_shapes(const engine::Context& context, const SkinSource& source,
                                                 int count, std::vector<body::Part>& parts) {
  const Scaling scaling(source.skin);
  const double mm = scaling.mm();
  const std::size_t samples = std::clamp<std::size_t>(60 * static_cast<std::size_t>(count), 3000, 40000);
  TightProblem problem(sample_near_skin(context, source, {samples, 8 * mm, 20 * mm, 0.7, 0.1, 200 * mm, 5}),
                       scaling.origin, scaling.scale, TightLoss{});
  std::vector<geometry::Ellipsoid> shapes;
  for (const auto& e : medial_start(context, source, count)) {
    shapes.push_back(scaling.in(e.shape));
    parts.push_back(e.part);
  }
  DescentOptions descent;
  descent.max_iterations = kCoveringIterations;
  descend(context, problem, shapes, descent);
  for (auto& e : shapes) e = scaling.out(e);
  return shapes;
}

/// Level of the worst of an item's points.
double item_level(const Items& items, Index item, const geometry::Ellipsoid& e) {
  double worst = 0.0;
  for (const Index p : items.encloses[item]) worst = std::max(worst, geometry::level(e, items.points[p]));
  return worst;
}

void fit_members(const engine::Context& context, const Items& items, double min_radius_m,
                 std::vector<Cluster>& clusters) {
  engine::parallel_for(context, clusters.size(), 2, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k)
      clusters[k].ellipsoid = mvee(enclosed_points(items, clusters[k]), {1e-4, min_radius_m}).ellipsoid;
  });
}

/// Each item to the ellipsoid where its level is least; empty ellipsoids are dropped; then enclosing
/// ellipsoids.
std::vector<Cluster> enclose(const engine::Context& context, const Items& items,
                             const std::vector<geometry::Ellipsoid>& shapes,
                             const std::vector<body::Part>& parts, double min_radius_m) {
  std::vector<std::size_t> home(items.where.size());
  engine::parallel_for(context, home.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      double least = 1e300;
      for (std::size_t k = 0; k < shapes.size(); ++k) {
        // The centroid of the item is a cheap bound: its level is at most the worst of the points'.
        if (geometry::level(shapes[k], items.where[i]) >= least) continue;
        const double level = item_level(items, static_cast<Index>(i), shapes[k]);
        if (level < least) least = level, home[i] = k;
      }
    }
  });
  std::vector<Cluster> clusters(shapes.size());
  for (std::size_t i = 0; i < home.size(); ++i) clusters[home[i]].items.push_back(static_cast<Index>(i));
  for (std::size_t k = 0; k < shapes.size(); ++k) clusters[k].part = parts[k];
  std::erase_if(clusters, [](const Cluster& c) { return c.items.empty(); });
  fit_members(context, items, min_radius_m, clusters);
  return clusters;
}

}  // namespace

Draft fit_solid(const engine::Context& context, const SkinSource& source, const FitOptions& options,
                int count) {
  const LabelledSkin& skin = source.skin;
  const double volume = std::abs(geometry::signed_volume(skin.mesh));
  const double min_radius_m = kMinRadius * skin.stature_m;
  const Items items =
      solid_items(skin, options.parts, interior_grid(skin.mesh, std::cbrt(volume / kAnchors)));
  Draft draft;
  draft.data.tier = proxy::Tier::kSolid;
  std::vector<Cluster> clusters;
  if (options.mu_torso_m && options.mu_limbs_m) {
    const Allocation done = clusters_by_threshold(context, items, skin, options, count);
    clusters = done.clusters();
    draft.mu = done.in_force;
    draft.thresholds_reached = done.reached;
  } else {
    std::vector<body::Part> parts;
    const auto shapes = covering_shapes(context, source, count, parts);
    clusters = enclose(context, items, shapes, parts, min_radius_m);
  }
  // A body of some parts only has no inside of its own: its anchors are what it covers.
  const bool all_parts = options.parts == (1u << body::kPartCount) - 1;
  const std::vector<Vec3> witnesses =
      all_parts ? interior_grid(skin.mesh, std::cbrt(volume / kWitnesses)) : std::vector<Vec3>{};
  cover(context, items, witnesses, min_radius_m, clusters);
  for (const Cluster& c : clusters) draft.data.ellipsoids.push_back({c.ellipsoid, c.part});
  return draft;
}

}  // namespace bodice::fitting
