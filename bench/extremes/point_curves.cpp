#include <algorithm>
#include <cmath>

#include <bodice/engine/random.hpp>
#include <bodice/fitting/kmeans.hpp>
#include <bodice/fitting/mvee.hpp>

#include "curve.hpp"
#include "reference.hpp"

namespace extremes_bench {
namespace {

using namespace bodice;
using geometry::Vec3;

constexpr std::size_t kPoints = 300, kCenters = 12;

/// A uniform point of [-1, 1]^3; the components are drawn in order, so that every compiler gives the same.
Vec3 in_cube(engine::Random& random) {
  Vec3 u;
  for (int axis = 0; axis < 3; ++axis) u[axis] = random.uniform(-1.0, 1.0);
  return u;
}

/// A box's corners and points inside it. Their least ellipsoid has sqrt(3) times the box's half sizes.
std::vector<Vec3> box_cloud(const Placement& placement) {
  engine::Random random(1);
  std::vector<Vec3> points;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 u(corner & 1 ? 1.0 : -1.0, corner & 2 ? 1.0 : -1.0, corner & 4 ? 1.0 : -1.0);
    points.push_back(placement.to_world(placement.extents_m().cwiseProduct(u)));
  }
  while (points.size() < kPoints)
    points.push_back(placement.to_world(placement.extents_m().cwiseProduct(in_cube(random))));
  return points;
}

/// The largest relative error of a radius.
double radius_error(const fitting::Mvee& found, const Placement& placement) {
  Vec3 radii = found.ellipsoid.radii;
  std::sort(radii.data(), radii.data() + 3, std::greater{});
  const Vec3 wanted = std::sqrt(3.0) * placement.extents_m();
  return (radii - wanted).cwiseQuotient(wanted).cwiseAbs().maxCoeff();
}

double outside(const fitting::Mvee& found, const std::vector<Vec3>& points, const Placement& placement) {
  double worst = 0.0;
  for (const Vec3& p : points) worst = std::max(worst, signed_distance(found.ellipsoid, p));
  return worst / placement.scale_m;
}

/// How much farther a point's center is than the center nearest to it, at most.
double assignment_error(const Placement& placement) {
  const std::vector<Vec3> points = box_cloud(placement);
  const std::vector<Vec3> centers(points.begin() + 8, points.begin() + 8 + kCenters);
  const auto found = fitting::kmeans({}, points, {}, centers, {});
  double worst = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    double least = 1e300;
    for (const Vec3& c : found.centers) least = std::min(least, (points[i] - c).norm());
    worst = std::max(worst, (points[i] - found.centers[found.of_point[i]]).norm() - least);
  }
  return worst / placement.scale_m;
}

}  // namespace

std::vector<Curve> point_curves() {
  return {{"mvee", "worst radius, to itself",
           [](const Placement& p) { return radius_error(fitting::mvee(box_cloud(p)), p); }},
          {"mvee", "farthest point outside, to size",
           [](const Placement& p) { return outside(fitting::mvee(box_cloud(p)), box_cloud(p), p); }},
          {"mvee_first_order (1e-3)", "worst radius, to itself",
           [](const Placement& p) { return radius_error(fitting::mvee_first_order(box_cloud(p), 1e-3), p); }},
          {"mvee_first_order (1e-3)", "farthest point outside, to size",
           [](const Placement& p) {
             return outside(fitting::mvee_first_order(box_cloud(p), 1e-3), box_cloud(p), p);
           }},
          {"kmeans", "center farther than the nearest, to size", assignment_error}};
}

}  // namespace extremes_bench
