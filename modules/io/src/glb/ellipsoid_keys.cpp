#include "ellipsoid_keys.hpp"

#include <array>

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace bodice::inline v0_1::io {
namespace {

using geometry::Mat3;
using geometry::Vec3;

/// The 24 rotations that map the axes of a box to each other.
std::vector<Mat3> box_rotations() {
  std::vector<Mat3> found;
  constexpr std::array<std::array<int, 3>, 6> kOrders = {
      {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
  for (const auto& order : kOrders)
    for (int signs = 0; signs < 8; ++signs) {
      Mat3 turn = Mat3::Zero();
      for (int column = 0; column < 3; ++column)
        turn(order[static_cast<std::size_t>(column)], column) = (signs >> column & 1) != 0 ? -1.0 : 1.0;
      if (turn.determinant() > 0.0) found.push_back(turn);
    }
  return found;
}

void append_floats(const Eigen::Ref<const Eigen::VectorXd>& values, std::vector<float>& out) {
  for (const double value : values) out.push_back(static_cast<float>(value));
}

}  // namespace

geometry::Ellipsoid aligned(const geometry::Ellipsoid& shape, const Mat3& before) {
  static const std::vector<Mat3> rotations = box_rotations();
  const Mat3 to_before = before.transpose() * shape.axes;
  const Mat3* best = &rotations.front();
  for (const Mat3& turn : rotations)
    if ((to_before * turn).trace() > (to_before * *best).trace()) best = &turn;
  return {shape.center, shape.axes * *best, (best->transpose() * shape.radii).cwiseAbs()};
}

void add_ellipsoid_keys(std::span<const geometry::Ellipsoid> shapes, std::size_t node, std::size_t times,
                        GlbBuilder& glb, GlbAnimation& animation) {
  std::vector<float> centers, turns, radii;
  Eigen::Quaterniond last = Eigen::Quaterniond::Identity();
  for (const geometry::Ellipsoid& shape : shapes) {
    Eigen::Quaterniond turn = Eigen::Quaterniond(shape.axes).normalized();
    if (turn.dot(last) < 0.0) turn.coeffs() *= -1.0;
    last = turn;
    append_floats(shape.center, centers);
    append_floats(turn.coeffs(), turns);
    append_floats(shape.radii, radii);
  }
  animation.add(node, "translation", times, glb.add_values(centers, "VEC3"), "LINEAR");
  animation.add(node, "rotation", times, glb.add_values(turns, "VEC4"), "LINEAR");
  animation.add(node, "scale", times, glb.add_values(radii, "VEC3"), "LINEAR");
}

}  // namespace bodice::io
