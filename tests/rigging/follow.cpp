#include "follow.hpp"

#include <algorithm>
#include <cmath>

#include <bodice/geometry/mesh_distance.hpp>

namespace posed {

using namespace bodice;
using geometry::Vec3;

std::vector<Vec3> follow(const rig::Rig& found, const std::vector<Vec3>& skin, const Motion& motion) {
  const auto& joints = found.skeleton.joints;
  std::vector<rig::Affine> turn(joints.size()), world(joints.size()), skinning(joints.size());
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const auto given = motion(joints[j].name);
    const auto parent = joints[j].parent;
    turn[j] = given ? *given : turn[parent];
    // The root is carried by the true map; all others hang on their parents by their own bones.
    Vec3 at = rig::apply(turn[j], joints[j].bind.col(3));
    if (parent >= 0) {
      const Vec3 bone = joints[j].bind.col(3) - joints[parent].bind.col(3);
      at = world[parent].col(3) + rig::linear_of(turn[parent]) * bone;
    }
    world[j] = rig::affine(rig::linear_of(turn[j]) * rig::linear_of(joints[j].bind), at);
  }
  rig::skinning_matrices(found.skeleton, world, skinning);
  std::vector<Vec3> posed(skin.size());
  rig::skin_linear(skin, found.weights, skinning, posed);
  return posed;
}

SkinError skin_error(const std::vector<Vec3>& points, const geometry::TriMesh& truth) {
  const geometry::MeshDistance distance({}, truth);
  std::vector<double> all;
  double sum = 0.0;
  for (const Vec3& p : points) {
    all.push_back(1e3 * std::abs(distance.closest_point(p).signed_distance));
    sum += all.back();
  }
  std::sort(all.begin(), all.end());
  return {sum / static_cast<double>(all.size()), all[all.size() * 95 / 100], all.back()};
}

}  // namespace posed
