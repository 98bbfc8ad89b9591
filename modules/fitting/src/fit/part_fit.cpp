#include "fit/part_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <bodice/engine/parallel.hpp>

#include "cluster/refinement.hpp"

namespace bodice::inline v0_1::fitting {
namespace {

constexpr std::size_t kPartGrain = 512;

/// The ellipsoid of a vertex's part that is nearest along the vertex's ray.
struct Nearest {
  double distance_m = std::numeric_limits<double>::infinity();
  std::size_t ellipsoid = 0;
};

using OfParts = std::array<std::vector<std::size_t>, body::kAllPartCount>;

std::vector<Nearest> find_nearest(const engine::Context& context, const LabeledSkin& skin,
                                  std::span<const proxy::ProxyEllipsoid> ellipsoids, const OfParts& of_part) {
  std::vector<Nearest> nearest(skin.part.size());
  engine::parallel_for(context, nearest.size(), kPartGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v)
      for (const std::size_t k : of_part[static_cast<int>(skin.part[v])]) {
        const double d = radial_distance(ellipsoids[k].shape, skin.mesh.positions[v]);
        if (d < nearest[v].distance_m) nearest[v] = {d, k};
      }
  });
  return nearest;
}

/// The E_j of the named ellipsoids; absent without ellipsoids or without clusters.
std::optional<ClusterError> cluster_error(std::span<const double> error_m,
                                          const std::vector<std::size_t>& of_part) {
  if (error_m.empty() || of_part.empty()) return std::nullopt;
  ClusterError found;
  for (const std::size_t k : of_part) {
    found.mean_m += error_m[k] / static_cast<double>(of_part.size());
    found.max_m = std::max(found.max_m, error_m[k]);
  }
  return found;
}

}  // namespace

std::vector<PartFit> part_fits(const engine::Context& context, const LabeledSkin& skin,
                               const FittedEllipsoids& fitted, const Measured& measured,
                               std::uint32_t parts) {
  const std::vector<proxy::ProxyEllipsoid>& ellipsoids = fitted.ellipsoids;
  std::vector<double> sum(ellipsoids.size(), 0.0), count(ellipsoids.size(), 0.0);
  std::array<PartFit, body::kAllPartCount> all{};
  OfParts of_part;
  for (std::size_t k = 0; k < ellipsoids.size(); ++k)
    of_part[static_cast<int>(ellipsoids[k].part)].push_back(k);
  const std::vector<Nearest> nearest = find_nearest(context, skin, ellipsoids, of_part);
  for (std::size_t v = 0; v < skin.part.size(); ++v) {
    ++all[static_cast<int>(skin.part[v])].vertices;
    if (std::isinf(nearest[v].distance_m)) continue;
    sum[nearest[v].ellipsoid] += nearest[v].distance_m;
    count[nearest[v].ellipsoid] += 1.0;
  }
  std::vector<PartFit> result;
  for (int part = 0; part < body::kAllPartCount; ++part) {
    PartFit& fit = all[part];
    if (fit.vertices == 0 || !((parts >> part) & 1u)) continue;
    fit.part = static_cast<body::Part>(part);
    fit.ellipsoids = of_part[part].size();
    double vertices = 0.0;
    for (const std::size_t k : of_part[part]) {
      if (count[k] == 0.0) continue;
      fit.radial_error_mean_m += sum[k];
      vertices += count[k];
      fit.radial_error_max_m = std::max(fit.radial_error_max_m, sum[k] / count[k]);
    }
    if (vertices > 0.0) fit.radial_error_mean_m /= vertices;
    fit.cluster_error = cluster_error(fitted.cluster_error_m, of_part[part]);
    fit.gap_m = measured.gap_of_part[part];
    result.push_back(fit);
  }
  return result;
}

}  // namespace bodice::fitting
