#include "made_rig.hpp"

#include <algorithm>
#include <cmath>

namespace io_test {

using namespace bodice::rig;

namespace {

Eigen::Quaterniond turn(double angle, const Vec3& axis) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis.normalized()));
}

Skeleton made_skeleton() {
  Skeleton skeleton;
  const auto add = [&](const char* name, std::int32_t parent, const LocalTransform& local) {
    Joint joint;
    joint.name = name;
    joint.parent = parent;
    joint.local = local;
    skeleton.joints.push_back(joint);
  };
  add("root", -1, {{0.1, 0.2, 0.0}, turn(0.3, {0, 1, 0}), Vec3::Ones()});
  add("low", 0, {{0, 0.3, 0}, turn(-0.2, {1, 0, 0}), {1.0, 1.5, 0.8}});
  add("middle", 1, {{0, 0.3, 0}, turn(0.4, {0, 0, 1}), Vec3::Ones()});
  add("idle", 2, {{0.2, 0, 0}, Eigen::Quaterniond::Identity(), Vec3::Ones()});
  add("high", 2, {{0, 0.3, 0}, turn(0.1, {1, 1, 0}), {0.9, 0.9, 0.9}});
  add("side", -1, {{-0.3, 1.0, 0.1}, turn(1.0, {0, 0, 1}), Vec3::Ones()});
  std::vector<Affine> world(skeleton.joints.size());
  rest_matrices(skeleton, world);
  for (std::size_t j = 0; j < world.size(); ++j) skeleton.joints[j].bind = world[j];
  // The file's nodes stand elsewhere than where the skin was bound.
  skeleton.joints[2].local.rotation = turn(-0.5, {0, 1, 1});
  return skeleton;
}

SkinWeights made_weights(const TriMesh& skin) {
  SkinWeights weights;
  weights.first.push_back(0);
  for (std::size_t v = 0; v < skin.positions.size(); ++v) {
    for (std::uint16_t j = 0; j < 6; ++j) {
      if (j == 3 || (v % 3 == 0 && j > 1)) continue;
      const double distance = skin.positions[v].y() - 0.3 * j;
      weights.joint.push_back(j);
      weights.weight.push_back(static_cast<float>(std::exp(-4.0 * distance * distance)));
    }
    weights.first.push_back(static_cast<std::uint32_t>(weights.joint.size()));
  }
  return weights;
}

Clip made_clip() {
  Clip clip{"all kinds", 2.0, {}};
  Track root;
  root.joint = 0;
  root.translation = {
      Interpolation::kCubic,
      {0.0, 2.0},
      {Vec3::Zero(), Vec3(0.1, 0.2, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0.3, 0.1, 0.2), Vec3::Zero()}};
  root.rotation = {Interpolation::kLinear, {0.5, 1.0}, {turn(0.3, {0, 1, 0}), turn(2.5, {0, 1, 1})}};
  Track low;
  low.joint = 1;
  low.scale = {Interpolation::kStep, {0.0, 1.0}, {{1.0, 1.5, 0.8}, {1.2, 0.7, 1.0}}};
  Track high;
  high.joint = 4;
  const Eigen::Quaterniond flat(0, 0, 0, 0), slow(0.0, 0.5, 0.0, 0.2);
  high.rotation = {Interpolation::kCubic,
                   {0.0, 2.0},
                   {flat, turn(0.1, {1, 1, 0}), slow, flat, turn(-1.2, {1, 0, 0}), flat}};
  clip.tracks = {root, low, high};
  return clip;
}

}  // namespace

Rig made_rig(const TriMesh& skin) {
  Rig rig{made_skeleton(), made_weights(skin), {made_clip()}};
  Clip still{"one key", 0.0, {}};
  Track side;
  side.joint = 5;
  side.rotation = {Interpolation::kLinear, {0.0}, {turn(-1.0, {0, 1, 0})}};
  still.tracks = {side};
  rig.clips.push_back(still);
  [[maybe_unused]] const auto mended = mend(rig, skin.positions.size());
  return rig;
}

std::vector<Vec3> posed(const TriMesh& skin, const Rig& rig, const Clip& clip, double time_s) {
  std::vector<Affine> world(rig.skeleton.joints.size()), skinning(world.size());
  joint_matrices(rig.skeleton, clip, time_s, world);
  skinning_matrices(rig.skeleton, world, skinning);
  std::vector<Vec3> result(skin.positions.size());
  skin_linear(skin.positions, rig.weights, skinning, result);
  return result;
}

}  // namespace io_test
