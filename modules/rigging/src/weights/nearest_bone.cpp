#include "weights/nearest_bone.hpp"

#include <algorithm>
#include <cmath>

#include <bodice/engine/parallel.hpp>

namespace bodice::inline v0_1::rigging {
namespace {

using body::JointId;
using body::LandmarkId;
using body::of_side;
using body::Part;

constexpr std::size_t kGrain = 2048;
// These planes give the heel to the foot and the jaw to the head, as rigs made by hand do.
const Vec3 kAnkleCut = Vec3(0.0, -1.0, 0.35).normalized();
const Vec3 kHeadCut = Vec3(0.0, 1.0, 0.5).normalized();
/// The skin over a clavicle begins beside the neck, at this fraction of the stature from the middle.
constexpr double kClavicleFrom = 0.045;

double distance_to_bone(const FoundJoints& joints, JointId id, const Vec3& p) {
  const Vec3& a = joints.at(id);
  const Vec3 bone = joints.tip(id) - a;
  const double along = std::clamp((p - a).dot(bone) / bone.squaredNorm(), 0.0, 1.0);
  return (p - a - along * bone).norm();
}

/// Whether a point lies beyond the joint, in the direction given in the joint's frame.
bool beyond(const FoundJoints& joints, JointId id, const Vec3& direction, const Vec3& p) {
  return (joints.axes(id) * direction).dot(p - joints.at(id)) > 0.0;
}

struct Sorter {
  const SkinCurves& skin;
  const FoundJoints& joints;
  double armpit = 0.0;  ///< height above the upper spine joint along the chest

  Sorter(const SkinCurves& s, const FoundJoints& j) : skin(s), joints(j) {
    const Vec3 up = joints.axes(JointId::kSpineUpper).col(1), from = joints.at(JointId::kSpineUpper);
    for (const LandmarkId id : {LandmarkId::kArmpitL, LandmarkId::kArmpitR})
      armpit += 0.5 * up.dot(skin.landmark(id).position - from);
  }

  JointId bone(geometry::Index v) const {
    const Part part = skin.anatomy().part[v];
    const Vec3& p = skin.skin().positions[v];
    if (part == Part::kHead)
      return beyond(joints, JointId::kHead, kHeadCut, p) ? JointId::kHead : JointId::kNeck;
    if (body::is_torso(part)) return torso_bone(p);
    const int side = (static_cast<int>(part) - static_cast<int>(Part::kUpperArmL)) % 2;
    switch (static_cast<Part>(static_cast<int>(part) - side)) {
      case Part::kUpperArmL:
        return of_side(JointId::kUpperArmL, side);
      case Part::kForearmL:
        return of_side(beyond(joints, of_side(JointId::kHandL, side), -Vec3::UnitY(), p) ? JointId::kHandL
                                                                                         : JointId::kForearmL,
                       side);
      case Part::kThighL:
        return of_side(JointId::kThighL, side);
      default:
        return of_side(lower_leg_bone(side, p), side);
    }
  }

  JointId lower_leg_bone(int side, const Vec3& p) const {
    const JointId foot = of_side(JointId::kFootL, side), toes = of_side(JointId::kToesL, side);
    if (!beyond(joints, foot, kAnkleCut, p)) return JointId::kCalfL;
    return beyond(joints, toes, Vec3::UnitZ(), p) ? JointId::kToesL : JointId::kFootL;
  }

  JointId torso_bone(const Vec3& p) const {
    if (!beyond(joints, JointId::kSpineLower, Vec3::UnitY(), p)) return JointId::kPelvis;
    if (!beyond(joints, JointId::kSpineMiddle, Vec3::UnitY(), p)) return JointId::kSpineLower;
    if (!beyond(joints, JointId::kSpineUpper, Vec3::UnitY(), p)) return JointId::kSpineMiddle;
    const Vec3 from = joints.axes(JointId::kSpineUpper).transpose() * (p - joints.at(JointId::kSpineUpper));
    const bool beside = std::abs(from.x()) > kClavicleFrom * skin.anatomy().stature_m;
    if (from.y() < armpit || !beside) return JointId::kSpineUpper;
    return from.x() > 0.0 ? JointId::kClavicleL : JointId::kClavicleR;
  }
};

}  // namespace

NearestBone nearest_bones(const engine::Context& context, const SkinCurves& skin, const FoundJoints& joints) {
  const std::size_t n = skin.skin().positions.size();
  const Sorter sorter(skin, joints);
  NearestBone nearest{std::vector<JointId>(n), std::vector<double>(n)};
  engine::parallel_for(context, n, kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      nearest.bone[v] = sorter.bone(static_cast<geometry::Index>(v));
      nearest.distance_m[v] = distance_to_bone(joints, nearest.bone[v], skin.skin().positions[v]);
    }
  });
  return nearest;
}

}  // namespace bodice::rigging
