#include "pose/pose.hpp"

#include <algorithm>
#include <numbers>

#include "pose/clearance.hpp"

namespace bodice::inline v0_1::synth {
namespace {

using Turn = Eigen::Matrix3d;

constexpr int kRandomTries = 64;
constexpr double kClavicleFrom_deg = 60.0;  // the shoulder girdle follows an arm that is raised further
constexpr double kClavicleShare = 0.3;

Turn about(const Vec3& axis, double degrees) {
  return Eigen::AngleAxisd(degrees * std::numbers::pi / 180.0, axis).toRotationMatrix();
}

const Vec3 kX = Vec3::UnitX(), kY = Vec3::UnitY(), kZ = Vec3::UnitZ();

using LocalTurns = std::array<Turn, kBoneCount>;

void turn_arm(const Figure& f, const ArmAngles& a, int side, LocalTurns& turn) {
  const double sign = side == 0 ? 1.0 : -1.0;
  const LimbAxes& axes = f.arm[side];
  const auto of = [&](Bone left) -> Turn& { return turn[index(of_side(left, side))]; };
  const double rest = 90.0 - Figure::kArmDrop_rad * 180.0 / std::numbers::pi;
  const double girdle = kClavicleShare * std::max(0.0, a.raise - kClavicleFrom_deg);
  of(Bone::kClavicleL) = about(kZ, sign * girdle);
  of(Bone::kUpperArmL) = about(kX, -a.forward) * about(kZ, sign * (a.raise - rest - girdle)) *
                         about(axes.along, -sign * a.twist);
  of(Bone::kForearmL) = about(-sign * axes.out, a.elbow);
  const Vec3 to_palm = sign * axes.front;  // turning about it moves the hand toward the palm
  of(Bone::kHandL) = about(-to_palm, a.wrist);
  of(Bone::kFingersL) = about(-to_palm, a.curl);
  of(Bone::kFingertipsL) = about(-to_palm, 1.3 * a.curl);
  of(Bone::kThumbL) = about(-to_palm, 0.3 * a.curl);
}

void turn_leg(const LegAngles& a, int side, LocalTurns& turn) {
  const double sign = side == 0 ? 1.0 : -1.0;
  const auto of = [&](Bone left) -> Turn& { return turn[index(of_side(left, side))]; };
  const double rest = Figure::kLegSpread_rad * 180.0 / std::numbers::pi;
  // The leg first becomes vertical, where the knee's axis is x; it is spread after it was swung.
  of(Bone::kThighL) =
      about(kZ, sign * a.spread) * about(kX, -a.flex) * about(kY, sign * a.twist) * about(kZ, -sign * rest);
  const Turn upright = about(kZ, -sign * rest);
  of(Bone::kCalfL) = upright.transpose() * about(kX, a.knee) * upright;
  // The foot is flat in the rest pose. Undoing the leg's lean keeps the sole square to the shin.
  of(Bone::kFootL) = upright.transpose() * about(kX, -a.ankle);
}

LocalTurns local_turns(const Figure& f, const PoseAngles& a) {
  LocalTurns turn;
  turn.fill(Turn::Identity());
  turn[index(Bone::kPelvis)] = about(kY, a.yaw) * about(kX, a.pitch) * about(kZ, a.roll);
  for (const auto& [bone, share] : {std::pair{Bone::kSpine, 0.5}, {Bone::kChest, 0.5}})
    turn[index(bone)] = about(kY, share * a.turn) * about(kX, share * a.lean) * about(kZ, -share * a.bend);
  for (const Bone bone : {Bone::kNeck, Bone::kHead})
    turn[index(bone)] = about(kY, 0.5 * a.look) * about(kX, 0.5 * a.nod);
  for (int side = 0; side < 2; ++side) {
    turn_arm(f, a.arm[side], side, turn);
    turn_leg(a.leg[side], side, turn);
  }
  return turn;
}

}  // namespace

BoneTransforms transforms(const Figure& figure, const PoseAngles& angles) {
  const LocalTurns turn = local_turns(figure, angles);
  BoneTransforms result;
  for (int b = 0; b < kBoneCount; ++b) {  // parents come first
    const Vec3& joint = figure.joint[b];
    Eigen::Isometry3d local = Eigen::Isometry3d::Identity();
    local.linear() = turn[b];
    local.translation() = joint - turn[b] * joint;
    const int above = index(parent(static_cast<Bone>(b)));
    result[b] = above == b ? local : result[above] * local;
  }
  return result;
}

BoneTransforms pose_figure(const Figure& figure, Pose pose, std::uint64_t seed) {
  BoneTransforms posed = transforms(figure, angles_of(pose, seed));
  if (pose != Pose::kRandom) return posed;
  double best = clearance(figure, posed);
  for (int k = 1; k < kRandomTries && best < 0.0; ++k) {
    const BoneTransforms other = transforms(figure, angles_of(pose, seed + 0x10000ull * k));
    const double distance = clearance(figure, other);
    if (distance > best) {
      best = distance;
      posed = other;
    }
  }
  return posed;
}

}  // namespace bodice::synth
