#include "posture/figure.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <bodice/engine/message.hpp>

namespace bodice::inline v0_1::rigging {
namespace {

using body::JointId;
using body::of_side;

bool may_be_absent(JointId id) {
  return id == JointId::kSpineMiddle || id == JointId::kClavicleL || id == JointId::kClavicleR ||
         id >= JointId::kToesL;
}

std::string named(JointId id) {
  return engine::message('"', body::name(id), '"');
}

engine::Error wrong(std::string message) {
  return {engine::ErrorCode::kInvalidArgument, std::move(message),
          "Make the clip for a made or found rig, and carry it over to this skeleton with rig::retarget."};
}

/// The nearest joint above that the skeleton has.
JointId parent_of(const Figure& figure, JointId id) {
  do id = body::parent(id);
  while (id != JointId::kPelvis && figure.index(id) < 0);
  return id;
}

std::optional<engine::Error> find_joints(const rig::Skeleton& skeleton, Figure& figure) {
  for (int i = 0; i < body::kJointCount; ++i) {
    const auto id = static_cast<JointId>(i);
    const auto found = rig::find_joint(skeleton, body::name(id));
    figure.joint[i] = found ? static_cast<int>(*found) : -1;
    if (!found && !may_be_absent(id))
      return wrong(engine::message("The skeleton has no joint ", named(id), ", which motions move."));
  }
  for (int i = 0; i < body::kJointCount; ++i) {
    const auto id = static_cast<JointId>(i);
    if (figure.joint[i] < 0) continue;
    const int parent = skeleton.joints[figure.joint[i]].parent;
    const int wanted = id == JointId::kPelvis ? rig::kNoParent : figure.index(parent_of(figure, id));
    if (parent != wanted)
      return wrong(engine::message("The skeleton's joint ", named(id), " is not carried by ",
                                   wanted < 0 ? std::string("none") : named(parent_of(figure, id)), "."));
  }
  return std::nullopt;
}

/// The position of a joint in the frame of its parent joint.
Vec3 offset(const rig::Skeleton& skeleton, const Figure& figure, JointId id) {
  const rig::Joint& joint = skeleton.joints[figure.index(id)];
  return rig::apply(rig::inverse(skeleton.joints[joint.parent].bind), joint.bind.col(3));
}

/// The distances of the ball in front of the ankle and below it, of a leg without a toes joint; multiples of
/// the calf.
constexpr double kBallOverCalf = 0.31, kDropOverCalf = 0.11;

LegLengths measure_leg(const rig::Skeleton& skeleton, const Figure& figure, int side) {
  LegLengths leg;
  leg.hip = offset(skeleton, figure, of_side(JointId::kThighL, side));
  leg.thigh = offset(skeleton, figure, of_side(JointId::kCalfL, side)).norm();
  leg.calf = offset(skeleton, figure, of_side(JointId::kFootL, side)).norm();
  const JointId toes = of_side(JointId::kToesL, side);
  const Vec3 ball = figure.index(toes) >= 0 ? offset(skeleton, figure, toes)
                                            : Vec3(0.0, -kDropOverCalf * leg.calf, kBallOverCalf * leg.calf);
  leg.ankle_height = std::max(0.0, -ball.y()) * body::kAnkleHeightOverDrop;
  leg.ball = {ball.x(), -leg.ankle_height, ball.z()};
  return leg;
}

/// The heading of a body: its front, made horizontal. The heading of a body that lies is toward its head or
/// its feet.
Mat3 heading_of(const Mat3& pelvis) {
  Vec3 front = pelvis.col(2);
  if (std::abs(front.y()) > 0.9) front = front.y() > 0.0 ? Vec3(-pelvis.col(1)) : Vec3(pelvis.col(1));
  front.y() = 0.0;
  front.normalize();
  Mat3 heading;
  heading << Vec3::UnitY().cross(front), Vec3::UnitY(), front;
  return heading;
}

}  // namespace

engine::Result<Figure> measure(const rig::Skeleton& skeleton) {
  Figure figure;
  if (auto error = find_joints(skeleton, figure)) return *error;
  double floor = 1e9;
  for (int side = 0; side < 2; ++side) {
    const LegLengths leg = figure.leg[side] = measure_leg(skeleton, figure, side);
    figure.hips_middle += 0.5 * leg.hip;
    figure.leg_m += 0.5 * (leg.thigh + leg.calf + leg.ankle_height);
    const rig::Affine& foot = skeleton.joints[figure.index(of_side(JointId::kFootL, side))].bind;
    floor = std::min(floor, rig::apply(foot, {0.0, -leg.ankle_height, 0.0}).y());
  }
  if (!(figure.leg_m > 0.0)) return wrong("The skeleton's legs have no length.");
  figure.hip_half_width = 0.5 * (figure.leg[0].hip - figure.leg[1].hip).norm() / figure.leg_m;
  const rig::Affine& pelvis = skeleton.joints[figure.index(JointId::kPelvis)].bind;
  figure.heading = heading_of(rig::linear_of(pelvis));
  const Vec3 hips = rig::apply(pelvis, figure.hips_middle);
  figure.origin = {hips.x(), floor, hips.z()};
  return figure;
}

}  // namespace bodice::rigging
