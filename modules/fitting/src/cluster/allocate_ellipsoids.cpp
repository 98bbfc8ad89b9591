#include "cluster/allocate_ellipsoids.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

#include <bodice/engine/parallel.hpp>

#include "base/tolerant_argmax.hpp"

namespace bodice::inline v0_1::fitting {
namespace {

constexpr std::size_t kMostPoints = 2048;  // points in all
constexpr std::size_t kLeastPoints = 4;    // a cluster with fewer points is not split

/// Points and the ellipsoid of their covariance, scaled to hold them all, in place of the least enclosing
/// ellipsoid.
struct PointGroup {
  std::vector<Vec3> points;
  Vec3 mean = Vec3::Zero(), longest = Vec3::UnitX();
  double error_m = 0.0;  ///< eq. (6) to the scaled ellipsoid

  explicit PointGroup(std::vector<Vec3> from) : points(std::move(from)) {
    const double n = static_cast<double>(points.size());
    for (const Vec3& p : points) mean += p / n;
    geometry::Mat3 spread = geometry::Mat3::Zero();
    for (const Vec3& p : points) spread += (p - mean) * (p - mean).transpose() / n;
    Eigen::SelfAdjointEigenSolver<geometry::Mat3> eigen;
    eigen.computeDirect(spread);
    longest = eigen.eigenvectors().col(2);
    const double floor = 1e-6 * eigen.eigenvalues()[2];
    if (!(floor > 0.0)) return;
    const Vec3 inverse = eigen.eigenvalues().cwiseMax(floor).cwiseInverse();
    std::vector<double> level;
    for (const Vec3& p : points)
      level.push_back((eigen.eigenvectors().transpose() * (p - mean)).cwiseAbs2().dot(inverse));
    const double most = *std::max_element(level.begin(), level.end());
    for (std::size_t i = 0; i < points.size(); ++i)
      if (level[i] > 0.0) error_m += (points[i] - mean).norm() * (std::sqrt(most / level[i]) - 1.0) / n;
  }
};

/// Splits the worst cluster until there are `most`; errors[k] is the largest error with k + 1 clusters.
std::vector<double> errors_before_splits(const engine::Context& context, std::vector<Vec3> points, int most) {
  std::vector<double> errors;
  std::vector<PointGroup> clusters;
  clusters.emplace_back(std::move(points));
  while (static_cast<int>(errors.size()) < most) {
    context.checkpoint();
    std::vector<double> error;
    for (const PointGroup& c : clusters) error.push_back(c.points.size() < kLeastPoints ? 0.0 : c.error_m);
    const std::size_t worst = tolerant_argmax(error);
    if (worst == clusters.size()) break;
    errors.push_back(clusters[worst].error_m);
    std::vector<Vec3> low, high;
    for (const Vec3& p : clusters[worst].points)
      ((p - clusters[worst].mean).dot(clusters[worst].longest) < 0.0 ? low : high).push_back(p);
    if (low.empty() || high.empty()) break;
    clusters[worst] = PointGroup(std::move(low));
    clusters.emplace_back(std::move(high));
  }
  return errors;
}

}  // namespace

std::vector<int> allocate_ellipsoids(const engine::Context& context, const Items& items,
                                     const std::vector<Region>& regions, int count) {
  const std::size_t stride = items.where.size() / kMostPoints + 1;
  std::vector<std::vector<double>> errors(regions.size());
  engine::parallel_for(context, regions.size(), 1, [&](std::size_t r, std::size_t) {
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < regions[r].items.size(); i += stride)
      points.push_back(items.where[regions[r].items[i]]);
    errors[r] = errors_before_splits(context, std::move(points), count);
    for (double& e : errors[r]) e /= regions[r].torso ? kTorsoToLimbs : 1.0;
  });
  std::vector<int> share;
  int left = count;
  for (const Region& region : regions) {
    share.push_back(
        std::max(1, static_cast<int>(region.seeds.size())));  // clusters that its refinement starts with
    left -= share.back();
  }
  for (; left > 0; --left) {
    std::vector<double> next(regions.size(), 0.0);
    for (std::size_t r = 0; r < regions.size(); ++r) {
      const auto splits = static_cast<std::size_t>(share[r] - 1);
      if (splits < errors[r].size()) next[r] = errors[r][splits];
    }
    const std::size_t worst = tolerant_argmax(next);
    if (worst == regions.size()) break;
    ++share[worst];
  }
  return share;
}

}  // namespace bodice::fitting
