#include <bodice/rigging/clear_arms.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <bodice/body/joint.hpp>
#include <bodice/rigging/motion.hpp>

namespace bodice::inline v0_1::rigging {
namespace {

using body::JointId;
using geometry::Vec3;

/// The room that an arm needs beside the body, as a share of its length: half its width, the sway of hips and
/// thighs, and some air.
constexpr double kHalfWidth = 0.115;
/// The range below the shoulder, as shares of the arm's length, in which an arm must clear the body. Above it
/// arm and trunk are joined.
constexpr double kFrom = 0.45, kTo = 1.0;
constexpr double kMost_deg = 30.0;

/// The angle between the vertical and an arm that clears everything beside it, in degrees, at a shoulder.
double needed_raise_deg(std::span<const Vec3> standing, std::span<const body::Part> part,
                        const Vec3& shoulder, double sign, double arm_m) {
  double most = 0.0;
  for (std::size_t v = 0; v < standing.size(); ++v) {
    if (part[v] >= body::Part::kUpperArmL && part[v] <= body::Part::kForearmR) continue;
    const double below = shoulder.y() - standing[v].y();
    if (below < kFrom * arm_m || below > kTo * arm_m) continue;
    const double beside = sign * (standing[v].x() - shoulder.x()) + kHalfWidth * arm_m;
    most = std::max(most, std::atan2(beside, below) * 180.0 / std::numbers::pi);
  }
  return most;
}

}  // namespace

double clear_arms_deg(const geometry::TriMesh& skin, std::span<const body::Part> part, const rig::Rig& rig) {
  const auto clip = make_clip(rig.skeleton, Motion::kArmsUp);
  if (!clip) return 0.0;
  std::vector<rig::Affine> world(rig.skeleton.joints.size()), skinning(world.size());
  rig::joint_matrices(rig.skeleton, *clip, 0.0, world);
  rig::skinning_matrices(rig.skeleton, world, skinning);
  std::vector<Vec3> standing(skin.positions.size());
  rig::skin_linear(skin.positions, rig.weights, skinning, standing);
  // The pelvis of the clip's first frame faces where the motion does: its axes are those of the standing
  // body.
  const geometry::Mat3 turn =
      rig::linear_of(world[*rig::find_joint(rig.skeleton, body::name(JointId::kPelvis))]).transpose();
  for (Vec3& p : standing) p = turn * p;
  const auto joint = [&](JointId id) {
    return Vec3(turn * world[*rig::find_joint(rig.skeleton, body::name(id))].col(3));
  };
  double needed = 0.0;
  for (int side = 0; side < 2; ++side) {
    const Vec3 shoulder = joint(body::of_side(JointId::kUpperArmL, side));
    const Vec3 elbow = joint(body::of_side(JointId::kForearmL, side)),
               hand = joint(body::of_side(JointId::kHandL, side));
    const double arm_m = (elbow - shoulder).norm() + (hand - elbow).norm();
    needed = std::max(needed, needed_raise_deg(standing, part, shoulder, side == 0 ? 1.0 : -1.0, arm_m));
  }
  return std::clamp(needed - kHangingRaise_deg, 0.0, kMost_deg);
}

}  // namespace bodice::rigging
