#include <bodice/binding/shape_offset.hpp>

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace bodice::inline v0_1::binding {
namespace {

using geometry::Mat3;
using geometry::Vec3;

/// No radius becomes less than this share of what it was.
constexpr double kLeastRadius = 0.2;

/// The turn, as axis times angle, that does most of G beside a diagonal: the least squares of turn S = G.
Vec3 turn_of(const Mat3& g, const Vec3& radii) {
  const auto about = [&](int i, int j) {
    return (radii[i] * g(j, i) - radii[j] * g(i, j)) / (radii[i] * radii[i] + radii[j] * radii[j]);
  };
  return {about(1, 2), about(2, 0), about(0, 1)};
}

}  // namespace

ShapeOffset offset_of(const geometry::Ellipsoid& own, const geometry::Ellipsoid& other) {
  const Mat3 to_units = own.radii.cwiseInverse().asDiagonal() * own.axes.transpose();
  return {to_units * (other.center - own.center),
          to_units * other.axes * other.radii.asDiagonal() - Mat3::Identity()};
}

void displace(const ShapeOffset& offset, double share, geometry::Ellipsoid& shape, Mat3& material) {
  if (share == 0.0) return;
  shape.center += share * material * offset.shift;
  // Material is U S V^T, with the axes U and the radii S.
  const Mat3 vt = shape.radii.cwiseInverse().asDiagonal() * shape.axes.transpose() * material;
  const Mat3 g = shape.radii.asDiagonal() * (vt * (share * offset.map) * vt.transpose());
  const Vec3 turn = turn_of(g, shape.radii);
  const double angle = turn.norm();
  if (angle > 0.0) shape.axes = shape.axes * Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix();
  shape.radii = (shape.radii + g.diagonal()).cwiseMax(kLeastRadius * shape.radii);
  material = shape.axes * shape.radii.asDiagonal() * vt;
}

}  // namespace bodice::binding
