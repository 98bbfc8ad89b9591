#include <bodice/geometry/ellipsoid.hpp>

#include <numbers>
#include <utility>

#include <Eigen/Geometry>

namespace bodice::inline v0_1::geometry {
namespace {

Vec3 to_local(const Ellipsoid& ellipsoid, const Vec3& point) {
  return ellipsoid.axes.transpose() * (point - ellipsoid.center);
}

}  // namespace

std::array<int, 3> axes_by_radius(const Vec3& radii) {
  std::array<int, 3> axes = {0, 1, 2};
  // Exchanges of neighbors keep equal radii in order, and neither allocate nor call: a moving collider does
  // this for each ellipsoid in each frame.
  const auto exchange = [&](int& a, int& b) {
    if (radii[a] < radii[b]) std::swap(a, b);
  };
  exchange(axes[0], axes[1]);
  exchange(axes[1], axes[2]);
  exchange(axes[0], axes[1]);
  return axes;
}

double level(const Ellipsoid& ellipsoid, const Vec3& point) {
  return to_local(ellipsoid, point).cwiseQuotient(ellipsoid.radii).squaredNorm();
}

double volume(const Ellipsoid& ellipsoid) {
  return 4.0 / 3.0 * std::numbers::pi * ellipsoid.radii.prod();
}

Box bounding_box(const Ellipsoid& ellipsoid) {
  // The half width along e_i is |diag(r) R^T e_i|, the norm of row i of R diag(r).
  const Vec3 half = (ellipsoid.axes * ellipsoid.radii.asDiagonal()).rowwise().norm();
  return {ellipsoid.center - half, ellipsoid.center + half};
}

Vec3 radial_projection(const Ellipsoid& ellipsoid, const Vec3& point) {
  Vec3 y = to_local(ellipsoid, point);
  const double size = y.cwiseAbs().maxCoeff();
  if (!(size > 0.0)) {
    int shortest = 0;
    ellipsoid.radii.minCoeff(&shortest);
    return ellipsoid.center + ellipsoid.radii[shortest] * ellipsoid.axes.col(shortest);
  }
  // The direction is normalized on the unit sphere before the radii apply: this is exact in scale however
  // near the center.
  const Vec3 w = (y / size).cwiseQuotient(ellipsoid.radii / ellipsoid.radii.maxCoeff()).stableNormalized();
  return ellipsoid.center + ellipsoid.axes * ellipsoid.radii.cwiseProduct(w);
}

}  // namespace bodice::geometry
