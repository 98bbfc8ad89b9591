// Hip, knee, ankle and the ball of the foot.
#include <algorithm>
#include <cmath>

#include "joints/offset_joints.hpp"
#include "joints/offsets.hpp"
#include "joints/sole.hpp"

namespace bodice::inline v0_1::rigging {
namespace {

using body::JointId;
using body::LandmarkId;
using body::of_side;
using body::Part;

std::vector<Vec3> foot_points(const SkinCurves& skin, int side) {
  const PartSet calf = parts({part_of_side(Part::kCalfL, side)});
  const auto from_toe = skin.distances_from(skin.landmark(of_side(LandmarkId::kToeL, side)).vertex);
  const auto reach = static_cast<float>(offsets::kFootReach * skin.anatomy().stature_m);
  std::vector<Vec3> points;
  for (geometry::Index v = 0; v < from_toe.size(); ++v)
    if (from_toe[v] <= reach && skin.is_in(v, calf)) points.push_back(skin.skin().positions[v]);
  return points;
}

/// A sole where the skin of the foot gives none: across the shin, from the knee to the toes.
Sole assumed_sole(const Vec3& across, const Vec3& shin, const Vec3& toe, double stature_m) {
  Sole sole;
  sole.frame = frame_of(across, -shin);
  sole.height = sole.frame.col(1).dot(toe) - 0.012 * stature_m;
  sole.front = sole.frame.col(2).dot(toe);
  sole.rear = sole.front - offsets::kFootReach * stature_m;
  return sole;
}

/// The rear end of the foot's section at the height of the ankle, across its middle, in the sole's frame.
Vec3 ankle_section(std::span<const Vec3> foot, const Sole& sole, double height) {
  geometry::Box box;
  for (const Vec3& p : foot) {
    const Vec3 in = sole.frame.transpose() * p;
    if (std::abs(in.y() - sole.height - height) < 0.35 * height) box.extend(in);
  }
  if (box.empty()) return {sole.frame.col(0).dot(foot.front()), sole.height + height, sole.rear};
  return {box.center().x(), sole.height + height, box.low.z()};
}

}  // namespace

void find_leg(const SkinCurves& skin, const BorderRings& rings, int side, FoundJoints& joints) {
  const double h = skin.anatomy().stature_m;
  const Mat3& pelvis = joints.axes(JointId::kPelvis);
  const Vec3 knee = skin.landmark(of_side(LandmarkId::kKneeL, side)).position;
  const Vec3 toe = skin.landmark(of_side(LandmarkId::kToeL, side)).position;
  const Vec3 hip = offset_joint(of_side(JointId::kThighL, side), skin, rings, joints);
  const Vec3 thigh = (knee - hip).normalized();
  const std::vector<Vec3> foot = foot_points(skin, side);
  geometry::Vec3 middle = Vec3::Zero();
  for (const Vec3& p : foot) middle += p / static_cast<double>(foot.size());
  const Vec3 shin = (middle - knee).normalized();
  // The ankle bends across the plane of shin and toes.
  const Vec3 toward_toe = toe - middle - (toe - middle).dot(shin) * shin;
  const Vec3 across = (-shin).cross(toward_toe).normalized();
  const auto found = find_sole(foot, across, shin);
  const Sole sole = found ? *found : assumed_sole(across, shin, toe, h);
  const double height = offsets::kAnkleHeight * h;
  const Vec3 section = ankle_section(foot, sole, height) + Vec3(0.0, 0.0, offsets::kAnkleFront * h);
  const Vec3 ankle = sole.frame * section;
  const double ball = sole.rear + offsets::kBall * (sole.front - sole.rear) - section.z();
  const Vec3 toes = ankle + sole.frame * Vec3(0.0, -height / body::kAnkleHeightOverDrop, ball);

  joints.at(of_side(JointId::kThighL, side)) = hip;
  joints.at(of_side(JointId::kCalfL, side)) = knee;
  joints.at(of_side(JointId::kFootL, side)) = ankle;
  joints.at(of_side(JointId::kToesL, side)) = toes;
  const Vec3 calf = (ankle - knee).normalized();
  const Mat3 upper = with_hinge(bone_frame(pelvis, thigh), calf, -1.0);
  joints.axes(of_side(JointId::kThighL, side)) = upper;
  joints.axes(of_side(JointId::kCalfL, side)) = bone_frame(upper, calf);
  joints.axes(of_side(JointId::kFootL, side)) = sole.frame;
  joints.axes(of_side(JointId::kToesL, side)) = sole.frame;
  joints.tip(of_side(JointId::kThighL, side)) = knee;
  joints.tip(of_side(JointId::kCalfL, side)) = ankle;
  joints.tip(of_side(JointId::kFootL, side)) = toes;
  joints.tip(of_side(JointId::kToesL, side)) = toe;
}

}  // namespace bodice::rigging
