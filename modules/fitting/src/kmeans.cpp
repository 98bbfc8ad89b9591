#include <bodice/fitting/kmeans.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <bodice/engine/parallel.hpp>

namespace bodice::fitting {
namespace {

constexpr std::size_t kGrain = 1024;

/// Coordinates as structure of arrays in float, relative to an origin near the points.
struct Local {
  Vec3 origin;
  std::array<std::vector<float>, 3> p;
};

Local make_local(std::span<const Vec3> points, const Vec3& origin) {
  Local local{origin, {}};
  for (int j = 0; j < 3; ++j) {
    local.p[j].resize(points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
      local.p[j][i] = static_cast<float>(points[i][j] - origin[j]);
  }
  return local;
}

/// Nearest centre of points [begin, end), at most kGrain of them.
void assign_block(const Local& local, std::span<const Vec3> centers, std::size_t begin, std::size_t end,
                  Index* of_point) {
  std::array<float, kGrain> best;
  std::array<Index, kGrain> which{};
  best.fill(std::numeric_limits<float>::infinity());
  const std::size_t n = end - begin;
  const float* x = local.p[0].data() + begin;
  const float* y = local.p[1].data() + begin;
  const float* z = local.p[2].data() + begin;
  for (Index k = 0; k < centers.size(); ++k) {
    const Eigen::Vector3f c = (centers[k] - local.origin).cast<float>();
    const float cx = c.x(), cy = c.y(), cz = c.z();
    for (std::size_t i = 0; i < n; ++i) {
      const float dx = x[i] - cx, dy = y[i] - cy, dz = z[i] - cz;
      const float d = dx * dx + dy * dy + dz * dz;
      which[i] = d < best[i] ? k : which[i];
      best[i] = d < best[i] ? d : best[i];
    }
  }
  std::copy_n(which.begin(), n, of_point + begin);
}

/// Weighted sums of the points of each cluster.
struct Sums {
  std::vector<Eigen::Vector4d> of_cluster;  ///< weighted position, weight
};

Sums sum_block(std::span<const Vec3> points, std::span<const double> weights,
               const std::vector<Index>& of_point, std::size_t clusters, std::size_t begin, std::size_t end) {
  Sums sums{std::vector<Eigen::Vector4d>(clusters, Eigen::Vector4d::Zero())};
  for (std::size_t i = begin; i < end; ++i) {
    const double w = weights.empty() ? 1.0 : weights[i];
    sums.of_cluster[of_point[i]] += w * Eigen::Vector4d(points[i].x(), points[i].y(), points[i].z(), 1.0);
  }
  return sums;
}

Sums add(Sums a, const Sums& b) {
  if (a.of_cluster.empty()) return b;
  for (std::size_t k = 0; k < b.of_cluster.size(); ++k) a.of_cluster[k] += b.of_cluster[k];
  return a;
}

/// Moves each centre to its cluster's mean; returns the largest move.
double move_centers(const Sums& sums, std::vector<Vec3>& centers) {
  double farthest = 0.0;
  for (std::size_t k = 0; k < centers.size(); ++k) {
    const Eigen::Vector4d& s = sums.of_cluster[k];
    if (!(s[3] > 0.0)) continue;
    const Vec3 mean = s.head<3>() / s[3];
    farthest = std::max(farthest, (mean - centers[k]).norm());
    centers[k] = mean;
  }
  return farthest;
}

}  // namespace

Clusters kmeans(const engine::Context& context, std::span<const Vec3> points, std::span<const double> weights,
                std::vector<Vec3> centers, const KMeansOptions& options) {
  Clusters result;
  result.of_point.resize(points.size());
  result.centers = std::move(centers);
  if (points.empty() || result.centers.empty()) return result;
  const Local local = make_local(points, result.centers.front());
  while (result.iterations < options.max_iterations) {
    const Sums sums = engine::ordered_reduce(
        context, points.size(), kGrain, Sums{},
        [&](std::size_t begin, std::size_t end) {
          assign_block(local, result.centers, begin, end, result.of_point.data());
          return sum_block(points, weights, result.of_point, result.centers.size(), begin, end);
        },
        [](Sums a, const Sums& b) { return add(std::move(a), b); });
    ++result.iterations;
    if (move_centers(sums, result.centers) <= options.sigma_m) break;
  }
  return result;
}

}  // namespace bodice::fitting
