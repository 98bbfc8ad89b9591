#include <bodice/fitting/kmeans.hpp>

#include "lloyd.hpp"

namespace bodice::fitting {

Clusters kmeans(const engine::Context& context, std::span<const Vec3> points, std::span<const double> weights,
                std::vector<Vec3> centers, const KMeansOptions& options) {
  if (points.empty() || centers.empty()) return {std::vector<Index>(points.size()), std::move(centers), 0};
  Lloyd lloyd(points, weights, points.front());
  const int iterations = lloyd.run(context, std::move(centers), options);
  return {lloyd.take_of_point(), lloyd.take_centers(), iterations};
}

}  // namespace bodice::fitting
