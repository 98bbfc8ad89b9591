#include "posture/pose.hpp"

#include <algorithm>
#include <cmath>

#include "posture/leg.hpp"
#include "posture/turns.hpp"

namespace bodice::inline v0_1::rigging {
namespace {

using body::JointId;
using body::of_side;

// The shoulder girdle follows an arm raised beyond this, with this share, as synth's bodies have it.
constexpr double kClavicleFrom_deg = 60.0;
constexpr double kClavicleShare = 0.3;
/// Longest stretch of a leg: the knee of a straight leg still bends by some nine degrees.
constexpr double kStretch = 0.997;

using Rotations = std::array<Mat3, body::kJointCount>;

/// Left and right, up and down are mirrored by the sign of a side.
double sign_of(int side) {
  return side == 0 ? 1.0 : -1.0;
}

Mat3 pelvis_frame(const Posture& p) {
  return about_y(p.yaw) * about_x(p.pitch) * about_z(p.roll);
}

Vec3 hips_position(const Figure& figure, const Posture& p) {
  return figure.leg_m * (Vec3(0.0, 1.0, 0.0) + p.hips);
}

void pose_spine(const Figure& figure, const Posture& p, Rotations& local) {
  const JointId spine[] = {JointId::kSpineLower, JointId::kSpineMiddle, JointId::kSpineUpper};
  const auto count =
      std::count_if(std::begin(spine), std::end(spine), [&](JointId id) { return figure.index(id) >= 0; });
  const double share = 1.0 / static_cast<double>(count);
  for (const JointId id : spine)
    if (figure.index(id) >= 0)
      local[static_cast<int>(id)] =
          about_y(share * p.turn) * about_x(share * p.lean) * about_z(-share * p.bend);
  for (const JointId id : {JointId::kNeck, JointId::kHead})
    local[static_cast<int>(id)] = about_y(0.5 * p.look) * about_x(0.5 * p.nod);
}

void pose_arm(const ArmPosture& a, const Figure& figure, int side, Rotations& local) {
  const double sign = sign_of(side);
  const auto of = [&](JointId left) -> Mat3& { return local[static_cast<int>(of_side(left, side))]; };
  const bool has_clavicle = figure.index(of_side(JointId::kClavicleL, side)) >= 0;
  // An arm that swings up in front lifts the girdle as one that is raised to the side does.
  const double height = std::max(a.raise, std::abs(a.forward));
  const double girdle = has_clavicle ? kClavicleShare * std::max(0.0, height - kClavicleFrom_deg) : 0.0;
  of(JointId::kClavicleL) = about_z(sign * girdle);
  of(JointId::kUpperArmL) =
      about_z(-sign * girdle) * about_x(-a.forward) * about_z(sign * a.raise) * about_y(-sign * a.twist);
  of(JointId::kForearmL) = about_x(-a.elbow);
  of(JointId::kHandL) = about_z(-sign * a.wrist);
}

void pose_leg(const Figure& figure, const Posture& p, const Mat3& pelvis, int side, Rotations& local,
              double lower) {
  const double sign = sign_of(side);
  const LegLengths& leg = figure.leg[side];
  const FootPosture& posture = p.foot[side];
  const Vec3 hips = hips_position(figure, p) - Vec3(0.0, lower * figure.leg_m, 0.0);
  const Vec3 hip = hips + pelvis * (leg.hip - figure.hips_middle);
  const double front = 0.5 * (p.yaw + posture.yaw) + sign * p.knee_out;
  const LegPose pose =
      solve_leg(leg, hip, place_foot(leg, posture, figure.leg_m), about_y(front) * Vec3::UnitZ());
  const auto of = [&](JointId left) -> Mat3& { return local[static_cast<int>(of_side(left, side))]; };
  of(JointId::kThighL) = pelvis.transpose() * pose.thigh;
  of(JointId::kCalfL) = pose.thigh.transpose() * pose.calf;
  of(JointId::kFootL) = pose.calf.transpose() * pose.foot;
  of(JointId::kToesL) = about_x(std::min(0.0, std::max(posture.pitch, -posture.toes)));
}

}  // namespace

double missing_reach(const Figure& figure, const Posture& posture) {
  const Mat3 pelvis = pelvis_frame(posture);
  double missing = 0.0;
  for (int side = 0; side < 2; ++side) {
    const LegLengths& leg = figure.leg[side];
    const Vec3 hip = hips_position(figure, posture) + pelvis * (leg.hip - figure.hips_middle);
    const Vec3 from = hip - place_foot(leg, posture.foot[side], figure.leg_m).ankle;
    const double reach = kStretch * (leg.thigh + leg.calf);
    const double across = std::hypot(from.x(), from.z());
    const double height = std::sqrt(std::max(0.0, reach * reach - across * across));
    missing = std::max(missing, from.y() - height);
  }
  return missing / figure.leg_m;
}

JointPose pose_joints(const Figure& figure, const Posture& posture, double lower) {
  const Mat3 pelvis = pelvis_frame(posture);
  Rotations local;
  local.fill(Mat3::Identity());
  local[static_cast<int>(JointId::kPelvis)] = figure.heading * pelvis;
  pose_spine(figure, posture, local);
  for (int side = 0; side < 2; ++side) {
    pose_arm(posture.arm[side], figure, side, local);
    pose_leg(figure, posture, pelvis, side, local, lower);
  }
  JointPose pose;
  const Vec3 hips = hips_position(figure, posture) - Vec3(0.0, lower * figure.leg_m, 0.0);
  pose.pelvis = figure.origin + figure.heading * (hips - pelvis * figure.hips_middle);
  for (int i = 0; i < body::kJointCount; ++i) pose.rotation[i] = Eigen::Quaterniond(local[i]).normalized();
  return pose;
}

}  // namespace bodice::rigging
