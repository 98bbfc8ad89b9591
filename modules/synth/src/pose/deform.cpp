// Based on: Ladislav Kavan, Steven Collins, Jiri Zara, Carol O'Sullivan. Skinning with dual quaternions.
// 2007.
#include "pose/deform.hpp"

#include <algorithm>

#include <bodice/engine/parallel.hpp>

namespace bodice::inline v0_1::synth {
namespace {

struct DualQuaternion {
  Eigen::Vector4d real, dual;  // coefficients x y z w
};

DualQuaternion dual_quaternion(const Eigen::Isometry3d& motion) {
  const Eigen::Quaterniond q(motion.linear());
  const Vec3 t = motion.translation();
  const Eigen::Quaterniond d = Eigen::Quaterniond(0.0, t.x(), t.y(), t.z()) * q;
  return {q.coeffs(), 0.5 * d.coeffs()};
}

Vec3 apply(const DualQuaternion& blended, const Vec3& p) {
  const double norm = blended.real.norm();
  const Eigen::Quaterniond q(Eigen::Vector4d(blended.real / norm));
  const Eigen::Quaterniond d(Eigen::Vector4d(blended.dual / norm));
  return q * p + 2.0 * (d * q.conjugate()).vec();
}

}  // namespace

std::vector<Vec3> deform(const engine::Context& context, const std::vector<Vec3>& rest,
                         const std::vector<BoneWeights>& weights, const BoneTransforms& bones) {
  std::array<DualQuaternion, kBoneCount> motion;
  for (int b = 0; b < kBoneCount; ++b) {
    motion[b] = dual_quaternion(bones[b]);
    const int above = index(parent(static_cast<Bone>(b)));
    if (motion[b].real.dot(motion[above].real) < 0.0) {  // the same motion by the shorter rotation
      motion[b].real = -motion[b].real;
      motion[b].dual = -motion[b].dual;
    }
  }
  std::vector<Vec3> posed(rest.size());
  engine::parallel_for(context, rest.size(), 2048, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      DualQuaternion sum{Eigen::Vector4d::Zero(), Eigen::Vector4d::Zero()};
      for (int b = 0; b < kBoneCount; ++b) {
        const double w = static_cast<double>(weights[v][b]);
        if (w == 0.0) continue;
        sum.real += w * motion[b].real;
        sum.dual += w * motion[b].dual;
      }
      posed[v] = apply(sum, rest[v]);
    }
  });
  return posed;
}

}  // namespace bodice::synth
