#include <bodice/rigging/clear_arms.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include <bodice/body/joint.hpp>
#include <bodice/geometry/mesh_distance.hpp>
#include <bodice/rigging/motion.hpp>

namespace bodice::inline v0_1::rigging {
namespace {

using body::JointId;
using geometry::Vec3;

/// The room that an arm needs beside hips and thighs, as a share of its length: half its width, the sway of
/// the body, and some air.
constexpr double kHalfWidth = 0.115;
/// The range below the shoulder, as shares of the arm's length, in which an arm must clear the body. Above it
/// arm and trunk are joined.
constexpr double kFrom = 0.45, kTo = 1.0;
constexpr double kMost_deg = 30.0;

/// The room that two layers of cloth take between arm and trunk.
constexpr double kRoom_m = 0.006;
/// The range around a shoulder in which arm and trunk may press on each other, as a share of the arm's
/// length.
constexpr double kArmpit = 0.36;
/// The skin that may be without that room, in squares of the arm's length. The end of an armpit always is.
constexpr double kCrease = 0.015;
/// Arms that are held out farther for the sake of armpits look stiff, so that those of heavy bodies press.
constexpr double kMostForArmpits_deg = 16.0;

/// How far arms move when a body takes another shape, and the share of the pressed skin within which they do
/// not.
constexpr double kStep_deg = 1.0 / 3.0, kSlack = 0.1;

/// A body that stands and faces +z.
struct Standing {
  geometry::TriMesh skin;
  std::vector<Vec3> joint;
};

/// Nothing if the rig does not have the common skeleton.
std::optional<Standing> stand(const geometry::TriMesh& skin, const rig::Rig& rig, double arms_out_deg) {
  const auto clip = make_clip(rig.skeleton, Motion::kArmsUp, {.arms_out_deg = arms_out_deg});
  if (!clip) return std::nullopt;
  std::vector<rig::Affine> world(rig.skeleton.joints.size()), skinning(world.size());
  rig::joint_matrices(rig.skeleton, *clip, 0.0, world);
  rig::skinning_matrices(rig.skeleton, world, skinning);
  Standing body;
  body.skin = {std::vector<Vec3>(skin.positions.size()), skin.triangles};
  rig::skin_linear(skin.positions, rig.weights, skinning, body.skin.positions);
  // The pelvis of the clip's first frame faces where the motion does: its axes are those of the standing
  // body.
  const geometry::Mat3 turn =
      rig::linear_of(world[*rig::find_joint(rig.skeleton, body::name(JointId::kPelvis))]).transpose();
  for (Vec3& p : body.skin.positions) p = turn * p;
  for (const rig::Affine& joint : world) body.joint.push_back(turn * Vec3(joint.col(3)));
  return body;
}

struct Arm {
  Vec3 shoulder;
  double length_m = 0.0;  ///< to the wrist
};

Arm arm_of(const Standing& body, const rig::Skeleton& skeleton, int side) {
  const auto joint = [&](JointId left) {
    return body.joint[*rig::find_joint(skeleton, body::name(body::of_side(left, side)))];
  };
  const Vec3 shoulder = joint(JointId::kUpperArmL), elbow = joint(JointId::kForearmL),
             hand = joint(JointId::kHandL);
  return {shoulder, (elbow - shoulder).norm() + (hand - elbow).norm()};
}

/// The angle between the vertical and an arm that clears everything beside it, in degrees, at a shoulder.
double raise_beside_hips_deg(std::span<const Vec3> standing, std::span<const body::Part> part, const Arm& arm,
                             double sign) {
  double most = 0.0;
  for (std::size_t v = 0; v < standing.size(); ++v) {
    if (part[v] >= body::Part::kUpperArmL && part[v] <= body::Part::kForearmR) continue;
    const double below = arm.shoulder.y() - standing[v].y();
    if (below < kFrom * arm.length_m || below > kTo * arm.length_m) continue;
    const double beside = sign * (standing[v].x() - arm.shoulder.x()) + kHalfWidth * arm.length_m;
    most = std::max(most, std::atan2(beside, below) * 180.0 / std::numbers::pi);
  }
  return most;
}

/// Area of the skin of trunk and upper arm around a shoulder that has other skin in front of it without room
/// for cloth, in squares of the arm's length.
double pressed_area(const geometry::TriMesh& skin, const geometry::MeshDistance& distance,
                    std::span<const body::Part> part, const Arm& arm) {
  double area = 0.0;
  for (const geometry::Triangle& t : skin.triangles) {
    if (part[t[0]] == body::Part::kForearmL || part[t[0]] == body::Part::kForearmR) continue;
    const Vec3 &a = skin.positions[t[0]], &b = skin.positions[t[1]], &c = skin.positions[t[2]];
    const Vec3 center = (a + b + c) / 3.0, across = (b - a).cross(c - a);
    if ((center - arm.shoulder).norm() > kArmpit * arm.length_m) continue;
    if (distance.inside(center + kRoom_m * across.normalized())) area += 0.5 * across.norm();
  }
  return area / (arm.length_m * arm.length_m);
}

/// The pressed area of both armpits with arms that are held out so far.
double pressed_area(const geometry::TriMesh& skin, std::span<const body::Part> part, const rig::Rig& rig,
                    double arms_out_deg) {
  const auto body = stand(skin, rig, arms_out_deg);
  const geometry::MeshDistance distance({}, body->skin);
  double area = 0.0;
  for (int side = 0; side < 2; ++side)
    area += pressed_area(body->skin, distance, part, arm_of(*body, rig.skeleton, side));
  return area;
}

/// The least angle, from one on, with which armpits have room for cloth, or the most that they are given.
double armpits_clear_deg(const geometry::TriMesh& skin, std::span<const body::Part> part, const rig::Rig& rig,
                         double from_deg) {
  if (from_deg >= kMostForArmpits_deg) return from_deg;
  // The farther out, the less skin is pressed: bisection to half a degree, and a straight line between.
  double low = from_deg, high = kMostForArmpits_deg;
  double area_low = pressed_area(skin, part, rig, low), area_high = pressed_area(skin, part, rig, high);
  if (area_low <= kCrease) return low;
  if (area_high >= kCrease) return high;
  while (high - low > 0.5) {
    const double middle = 0.5 * (low + high), area = pressed_area(skin, part, rig, middle);
    (area > kCrease ? low : high) = middle;
    (area > kCrease ? area_low : area_high) = area;
  }
  return low + (high - low) * (area_low - kCrease) / (area_low - area_high);
}

/// The angle with which hands pass hips and thighs; nothing if the rig does not have the common skeleton.
std::optional<double> hands_clear_deg(const geometry::TriMesh& skin, std::span<const body::Part> part,
                                      const rig::Rig& rig) {
  const auto hanging = stand(skin, rig, 0.0);
  if (!hanging) return std::nullopt;
  double raise = 0.0;
  for (int side = 0; side < 2; ++side)
    raise =
        std::max(raise, raise_beside_hips_deg(hanging->skin.positions, part,
                                              arm_of(*hanging, rig.skeleton, side), side == 0 ? 1.0 : -1.0));
  return std::clamp(raise - kHangingRaise_deg, 0.0, kMost_deg);
}

}  // namespace

double clear_arms_deg(const geometry::TriMesh& skin, std::span<const body::Part> part, const rig::Rig& rig) {
  const auto hands = hands_clear_deg(skin, part, rig);
  return hands ? armpits_clear_deg(skin, part, rig, *hands) : 0.0;
}

double keep_arms_clear_deg(const geometry::TriMesh& skin, std::span<const body::Part> part,
                           const rig::Rig& rig, double before_deg) {
  const auto hands = hands_clear_deg(skin, part, rig);
  if (!hands) return 0.0;
  const double area = pressed_area(skin, part, rig, before_deg);
  double next = before_deg;
  if (area > kCrease) next = std::min(before_deg + kStep_deg, std::max(before_deg, kMostForArmpits_deg));
  if (area < kCrease * (1.0 - kSlack)) next = before_deg - kStep_deg;
  return std::clamp(next, *hands, std::max(*hands, kMostForArmpits_deg));
}

}  // namespace bodice::rigging
