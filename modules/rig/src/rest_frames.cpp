#include "rest_frames.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <string_view>

#include <bodice/geometry/smallest_turn.hpp>

namespace bodice::inline v0_1::rig {

namespace {

using Eigen::Quaterniond;

/// Fronts that differ by less are the same: left and right joints of a rest pose are rarely exactly abreast.
constexpr double kSameFront_rad = 15.0 * std::numbers::pi / 180.0;
/// A lowest joint above or below the ground by this fraction of the hips' height is not on the ground: the
/// rest pose of many BVH files has its hips at the origin.
constexpr double kOffGround = 0.25;

std::size_t target_named(const JointMatch& match, std::string_view name) {
  const auto found = std::find(match.name.begin(), match.name.end(), name);
  return found == match.name.end() ? kNoIndex : static_cast<std::size_t>(found - match.name.begin());
}

/// The horizontal directions from the right side of each body to its left; zero where the names of joints do
/// not show them.
std::pair<Vec3, Vec3> sideways(const RestFrames& source, const RestFrames& target, const JointMatch& match) {
  for (const std::string part : {"thigh", "upperarm"}) {
    const std::size_t left = target_named(match, part + "_l"), right = target_named(match, part + "_r");
    if (left == kNoIndex || right == kNoIndex) continue;
    Vec3 from = source.position[match.source_of[left]] - source.position[match.source_of[right]];
    Vec3 to = target.position[left] - target.position[right];
    from.y() = to.y() = 0.0;
    if (from.norm() > 0.0 && to.norm() > 0.0) return {from.normalized(), to.normalized()};
  }
  return {Vec3::Zero(), Vec3::Zero()};
}

Quaterniond facing_of(const RestFrames& source, const RestFrames& target, const JointMatch& match) {
  const auto [from, to] = sideways(source, target, match);
  const double angle = std::atan2(from.cross(to).y(), from.dot(to));
  return std::abs(angle) < kSameFront_rad ? Quaterniond::Identity()
                                          : Quaterniond(Eigen::AngleAxisd(angle, Vec3::UnitY()));
}

double lowest(const RestFrames& rest) {
  double low = std::numeric_limits<double>::infinity();
  for (const Vec3& p : rest.position) low = std::min(low, p.y());
  return low;
}

bool turns_by_direction(std::string_view name) {
  return name.starts_with("thigh_") || name.starts_with("calf_") || name.starts_with("upperarm_") ||
         name.starts_with("forearm_");
}
bool turns_with_parent(std::string_view name) {
  for (const std::string_view part : {"hand_", "thumb_", "index_", "middle_", "ring_", "pinky_"})
    if (name.starts_with(part)) return true;
  return false;
}

std::string_view next_of(std::string_view part) {
  if (part == "thigh") return "calf";
  if (part == "calf") return "foot";
  return part == "upperarm" ? "forearm" : "hand";
}

/// The rotation of a limb's rest direction to the source's, seen from the target's front.
Quaterniond between_directions(const RestFrames& source, const RestFrames& target, const JointMatch& match,
                               const Quaterniond& facing, std::size_t joint) {
  const std::string& name = match.name[joint];
  const std::size_t bar = name.rfind('_');
  const std::size_t next = target_named(match, std::string(next_of(name.substr(0, bar))) + name.substr(bar));
  if (next == kNoIndex) return Quaterniond::Identity();
  const Vec3 to = source.position[match.source_of[next]] - source.position[match.source_of[joint]];
  const Vec3 from = target.position[next] - target.position[joint];
  if (!(to.norm() > 0.0) || !(from.norm() > 0.0)) return Quaterniond::Identity();
  return geometry::smallest_turn(from, facing * to);
}

}  // namespace

std::vector<Quaterniond> world_rotations(const Skeleton& skeleton, std::span<const LocalTransform> local) {
  std::vector<Quaterniond> world(skeleton.joints.size());
  for (std::size_t j = 0; j < world.size(); ++j) {
    const std::int32_t parent = skeleton.joints[j].parent;
    world[j] = local[j].rotation.normalized();
    if (parent >= 0) world[j] = (world[static_cast<std::size_t>(parent)] * world[j]).normalized();
  }
  return world;
}

RestFrames rest_frames(const Skeleton& skeleton) {
  std::vector<LocalTransform> local;
  for (const Joint& joint : skeleton.joints) local.push_back(joint.local);
  std::vector<Affine> world(skeleton.joints.size());
  rest_matrices(skeleton, world);
  RestFrames rest{world_rotations(skeleton, local), {}};
  for (const Affine& map : world) rest.position.push_back(map.col(3));
  return rest;
}

Alignment plan_alignment(const RestFrames& source_rest, const Skeleton& target, const RestFrames& target_rest,
                         const JointMatch& match) {
  Alignment plan;
  plan.facing = facing_of(source_rest, target_rest, match);
  plan.align.assign(target.joints.size(), Quaterniond::Identity());
  for (std::size_t j = 0; j < target.joints.size(); ++j) {
    const std::int32_t parent = target.joints[j].parent;
    const std::string& name = match.name[j];
    if (turns_by_direction(name))
      plan.align[j] = between_directions(source_rest, target_rest, match, plan.facing, j);
    else if (parent >= 0 && (turns_with_parent(name) || (name.empty() && match.source_of[j] != kNoIndex)))
      plan.align[j] = plan.align[static_cast<std::size_t>(parent)];  // a twist bone turns with its limb
  }
  const double source_low = lowest(source_rest), target_low = lowest(target_rest);
  plan.source_hips_at_rest = source_rest.position[match.source_hips];
  const double source_height = plan.source_hips_at_rest.y() - source_low;
  const double target_height = target_rest.position[match.target_hips].y() - target_low;
  if (source_height > 0.0 && target_height > 0.0) plan.root_scale = target_height / source_height;
  plan.ground_unknown = std::abs(source_low) > kOffGround * source_height;
  if (plan.ground_unknown) plan.source_hips_at_rest.y() = source_height;
  return plan;
}

}  // namespace bodice::rig
