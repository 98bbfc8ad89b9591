#include "skin/medial_initialization.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Eigenvalues>

#include <bodice/fitting/kmeans.hpp>

namespace bodice::inline v0_1::fitting {
namespace {

using Balls = std::vector<InscribedBall>;

/// Allocates by greedy highest averages: each ellipsoid goes to the part with the most demand for each it
/// has.
std::array<int, body::kAllPartCount> share(const std::array<double, body::kAllPartCount>& demand_of,
                                           int count) {
  std::array<int, body::kAllPartCount> given{};
  for (int n = 0; n < count; ++n) {
    int best = 0;
    double most = 0.0;
    for (int p = 0; p < body::kAllPartCount; ++p) {
      const double need = given[p] == 0 && demand_of[p] > 0.0 ? 1e300 : demand_of[p] / (given[p] + 0.5);
      if (need > most) most = need, best = p;
    }
    if (most == 0.0) break;
    ++given[best];
  }
  return given;
}

/// Seeds spread out over the points: each is the point farthest from the seeds before it.
std::vector<Vec3> farthest_seeds(const std::vector<Vec3>& points, int count) {
  std::vector<Vec3> seeds = {points[0]};
  std::vector<double> nearest(points.size(), 1e300);
  while (static_cast<int>(seeds.size()) < count) {
    std::size_t far = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      nearest[i] = std::min(nearest[i], (points[i] - seeds.back()).squaredNorm());
      if (nearest[i] > nearest[far]) far = i;
    }
    if (!(nearest[far] > 0.0)) break;
    seeds.push_back(points[far]);
  }
  return seeds;
}

/// The ellipsoid with the mean and covariance of the points; even points on its surface have covariance
/// diag(r^2) / 3.
geometry::Ellipsoid from_spread(const std::vector<Vec3>& points, double min_radius_m) {
  Vec3 mean = Vec3::Zero();
  for (const Vec3& p : points) mean += p / static_cast<double>(points.size());
  geometry::Mat3 covariance = geometry::Mat3::Zero();
  for (const Vec3& p : points) covariance += (p - mean) * (p - mean).transpose();
  covariance /= static_cast<double>(points.size());
  const Eigen::SelfAdjointEigenSolver<geometry::Mat3> eigen(covariance);
  geometry::Ellipsoid e;
  e.center = mean;
  e.axes = eigen.eigenvectors();
  if (e.axes.determinant() < 0.0) e.axes.col(2) = -e.axes.col(2);
  e.radii = (3.0 * eigen.eigenvalues()).cwiseMax(0.0).cwiseSqrt().cwiseMax(min_radius_m);
  return e;
}

}  // namespace

double demand(const InscribedBall& ball, double stature_m) {
  return std::pow(std::max(ball.radius_m, 1e-4 * stature_m), -0.7);
}

std::vector<proxy::ProxyEllipsoid> ellipsoids_from_balls(const engine::Context& context,
                                                         std::span<const InscribedBall> balls, int count,
                                                         double stature_m) {
  std::vector<Vec3> centers;
  std::vector<double> weights;
  for (const InscribedBall& b : balls) {
    centers.push_back(b.center);
    weights.push_back(demand(b, stature_m));
  }
  const Clusters found =
      kmeans(context, centers, weights, farthest_seeds(centers, count), {1e-4 * stature_m, 30});
  std::vector<std::vector<Vec3>> touched(found.centers.size());
  for (std::size_t i = 0; i < balls.size(); ++i) touched[found.of_point[i]].push_back(balls[i].skin);
  std::vector<proxy::ProxyEllipsoid> ellipsoids;
  for (const auto& points : touched)
    if (points.size() >= 4) ellipsoids.push_back({from_spread(points, 1e-3 * stature_m), balls.front().part});
  return ellipsoids;
}

std::vector<proxy::ProxyEllipsoid> medial_initialization(const engine::Context& context,
                                                         const SkinSource& source, int count) {
  const LabeledSkin& skin = source.skin;
  const std::size_t samples = std::clamp<std::size_t>(40 * static_cast<std::size_t>(count), 1500, 12000);
  std::array<Balls, body::kAllPartCount> of_part;
  std::array<double, body::kAllPartCount> demand_of{};
  const SkinSource whole{skin, kAllParts, source.buried};
  for (const InscribedBall& b : inscribed_balls(context, whole, samples, 3)) {
    of_part[static_cast<int>(b.part)].push_back(b);
    demand_of[static_cast<int>(b.part)] += demand(b, skin.stature_m);
  }
  const auto parts = std::count_if(demand_of.begin(), demand_of.end(), [](double d) { return d > 0.0; });
  if (source.parts == kAllParts && count < parts) {  // there are too few to give each part its own
    Balls all;
    for (const Balls& balls : of_part) all.insert(all.end(), balls.begin(), balls.end());
    return ellipsoids_from_balls(context, all, count, skin.stature_m);
  }
  const auto wanted = [&](int p) { return ((source.parts >> p) & 1u) != 0; };
  auto given = share(demand_of, count);
  int ours = 0;
  for (int p = 0; p < body::kAllPartCount; ++p) {
    if (!wanted(p)) demand_of[p] = given[p] = 0;
    ours += given[p];
  }
  if (ours == 0) given = share(demand_of, 1);  // count is smaller than the number of parts
  std::vector<proxy::ProxyEllipsoid> ellipsoids;
  for (int p = 0; p < body::kAllPartCount; ++p) {
    if (given[p] == 0) continue;
    const auto more = ellipsoids_from_balls(context, of_part[p], given[p], skin.stature_m);
    ellipsoids.insert(ellipsoids.end(), more.begin(), more.end());
  }
  return ellipsoids;
}

}  // namespace bodice::fitting
