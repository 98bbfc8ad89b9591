#include "skin/air_samples.hpp"

#include <algorithm>
#include <cmath>

#include <bodice/engine/parallel.hpp>

#include "base/ellipsoid_surface.hpp"

namespace bodice::inline v0_1::fitting {
namespace {

constexpr int kLeastProbes = 12;  // probes of the smallest ellipsoid

bool inside_another(std::span<const geometry::Ellipsoid> ellipsoids, std::size_t own, const Vec3& p) {
  for (std::size_t k = 0; k < ellipsoids.size(); ++k)
    if (k != own && geometry::level(ellipsoids[k], p) < 1.0) return true;
  return false;
}

}  // namespace

std::vector<DistanceSample> samples_in_air(const engine::Context& context, const SkinSource& source,
                                           std::span<const geometry::Ellipsoid> ellipsoids, std::size_t count,
                                           double gap_m, double most_m) {
  const LabeledSkin& skin = source.skin;
  double total = 0.0;
  for (const auto& e : ellipsoids) total += surface_area(e.radii);
  std::vector<std::vector<DistanceSample>> found(ellipsoids.size());
  engine::parallel_for(context, ellipsoids.size(), 1, [&](std::size_t k, std::size_t) {
    const double share = static_cast<double>(count) * surface_area(ellipsoids[k].radii) / total;
    for (const SurfaceProbe& probe : probe_surface(ellipsoids[k], kLeastProbes + static_cast<int>(share))) {
      if (inside_another(ellipsoids, k, probe.point)) continue;
      const auto hit = skin.distance->closest_point_within(probe.point, most_m);
      if (!hit) {
        if (!skin.distance->inside(probe.point)) found[k].push_back({probe.point, most_m});
        continue;
      }
      const double d = std::abs(hit->signed_distance), side = hit->normal.dot(probe.point - hit->point);
      if (d <= gap_m || source.buried[hit->triangle]) continue;
      const bool outside = std::abs(side) > 0.7 * d ? side > 0.0 : !skin.distance->inside(probe.point);
      const body::Part part = skin.part[skin.mesh.triangles[hit->triangle][0]];
      if (outside) found[k].push_back({probe.point, d, part});
    }
  });
  std::vector<DistanceSample> samples;
  for (const auto& of_one : found) samples.insert(samples.end(), of_one.begin(), of_one.end());
  return samples;
}

}  // namespace bodice::fitting
