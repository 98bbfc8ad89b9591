// Based on: Ladislav Kavan, Steven Collins, Jiri Zara, Carol O'Sullivan. Geometric Skinning with Approximate
// Dual Quaternion Blending. 2008. - sections 3 (linear blending of dual quaternions), 4.2 (scale and shear in
// a first phase) Differs: the signs of the blended quaternions follow the vertex's first joint; a reflection
// is part of the stretch.
#include <bodice/engine/parallel.hpp>
#include <bodice/geometry/decompositions.hpp>
#include <bodice/rig/skinning.hpp>

#include "grain.hpp"

namespace bodice::inline v0_1::rig {

namespace {

using Eigen::Quaterniond;
using Eigen::Vector4d;

/// The rotation nearest to a matrix; never a reflection.
Mat3 nearest_rotation(const Mat3& linear) {
  auto [u, values, v, is_valid] = geometry::singular_values(linear);
  if ((u * v.transpose()).determinant() < 0.0) u.col(2) = -u.col(2);
  return u * v.transpose();
}

DualQuaternion decompose(const Affine& map) {
  DualQuaternion result;
  const Mat3 linear = linear_of(map);
  if (!linear.allFinite()) {  // the decomposition has no answer; what is not finite shows in the stretch
    result.stretch = linear;
    return result;
  }
  const Mat3 rotation = nearest_rotation(linear);
  result.stretch = rotation.transpose() * linear;
  result.real = Quaterniond(rotation);
  const Vec3 shift = 0.5 * map.col(3);
  result.dual = Quaterniond(0.0, shift.x(), shift.y(), shift.z()) * result.real;
  return result;
}

Vec3 skin_vertex(const Vec3& rest, const SkinWeights& weights, std::size_t vertex,
                 std::span<const DualQuaternion> motion) {
  const std::size_t begin = weights.first[vertex], end = weights.first[vertex + 1];
  const DualQuaternion& base = motion[weights.joint[begin]];
  double left = 1.0;
  Vector4d real = Vector4d::Zero(), dual = Vector4d::Zero();
  Mat3 stretch = base.stretch;
  for (std::size_t e = begin + 1; e < end; ++e) {
    const DualQuaternion& other = motion[weights.joint[e]];
    const double weight = static_cast<double>(weights.weight[e]);
    const double turned = base.real.coeffs().dot(other.real.coeffs()) < 0.0 ? -weight : weight;
    real += turned * other.real.coeffs();
    dual += turned * other.dual.coeffs();
    stretch += weight * (other.stretch - base.stretch);
    left -= weight;
  }
  real += left * base.real.coeffs();
  dual += left * base.dual.coeffs();
  const double length = real.norm();  // positive: no term points against the first joint's
  const Quaterniond turn(Vector4d(real / length)), moved(Vector4d(dual / length));
  return turn * Vec3(stretch * rest) + 2.0 * (moved * turn.conjugate()).vec();
}

}  // namespace

void dual_quaternions(std::span<const Affine> skinning, std::span<DualQuaternion> out) {
  for (std::size_t j = 0; j < skinning.size(); ++j) out[j] = decompose(skinning[j]);
}

void skin_dual_quaternion(std::span<const Vec3> rest, const SkinWeights& weights,
                          std::span<const DualQuaternion> motion, std::span<Vec3> posed) {
  for (std::size_t v = 0; v < rest.size(); ++v) posed[v] = skin_vertex(rest[v], weights, v, motion);
}

void skin_dual_quaternion(const engine::Context& context, std::span<const Vec3> rest,
                          const SkinWeights& weights, std::span<const DualQuaternion> motion,
                          std::span<Vec3> posed) {
  engine::parallel_for(context, rest.size(), kSkinGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) posed[v] = skin_vertex(rest[v], weights, v, motion);
  });
}

}  // namespace bodice::rig
