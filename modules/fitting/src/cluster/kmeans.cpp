#include <bodice/fitting/kmeans.hpp>

#include <algorithm>

#include "cluster/lloyd.hpp"

namespace bodice::inline v0_1::fitting {
namespace {

Clusters of_finite(const engine::Context& context, std::span<const Vec3> points,
                   std::span<const double> weights, std::vector<Vec3> centers, const KMeansOptions& options) {
  if (points.empty() || centers.empty()) return {std::vector<Index>(points.size()), std::move(centers), 0};
  Lloyd lloyd(points, weights, points.front());
  const int iterations = lloyd.run(context, std::move(centers), options);
  return {lloyd.of_point(), lloyd.take_centers(), iterations};
}

}  // namespace

Clusters kmeans(const engine::Context& context, std::span<const Vec3> points, std::span<const double> weights,
                std::vector<Vec3> centers, const KMeansOptions& options) {
  const auto finite = [](const Vec3& p) { return p.allFinite(); };
  if (std::ranges::all_of(points, finite))
    return of_finite(context, points, weights, std::move(centers), options);
  std::vector<Vec3> kept;
  std::vector<double> weight_of_kept;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!finite(points[i])) continue;
    kept.push_back(points[i]);
    if (!weights.empty()) weight_of_kept.push_back(weights[i]);
  }
  Clusters clusters = of_finite(context, kept, weight_of_kept, std::move(centers), options);
  std::vector<Index> of_point(points.size(), geometry::kNoIndex);
  for (std::size_t i = 0, k = 0; i < points.size(); ++i)
    if (finite(points[i])) of_point[i] = clusters.of_point[k++];
  clusters.of_point = std::move(of_point);
  return clusters;
}

}  // namespace bodice::fitting
