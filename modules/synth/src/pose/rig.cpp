#include "pose/rig.hpp"

#include <optional>
#include <string>

#include <bodice/body/joint.hpp>

namespace bodice::inline v0_1::synth {
namespace {

constexpr float kLeastWeight = 1e-4f;

std::string rig_name(Bone bone) {
  using body::JointId;
  if (bone == Bone::kPelvis) return std::string(body::name(JointId::kPelvis));
  if (bone == Bone::kSpine) return std::string(body::name(JointId::kSpineLower));
  if (bone == Bone::kChest) return std::string(body::name(JointId::kSpineUpper));
  if (bone <= Bone::kHead)
    return std::string(body::name(bone == Bone::kNeck ? JointId::kNeck : JointId::kHead));
  const int side = (index(bone) - index(Bone::kClavicleL)) % 2;
  const auto left = static_cast<Bone>(index(bone) - side);
  const char* end = side == 0 ? "_l" : "_r";
  const auto common = [&](JointId id) { return std::string(body::name(body::of_side(id, side))); };
  switch (left) {
    case Bone::kClavicleL:
      return common(JointId::kClavicleL);
    case Bone::kUpperArmL:
      return common(JointId::kUpperArmL);
    case Bone::kForearmL:
      return common(JointId::kForearmL);
    case Bone::kHandL:
      return common(JointId::kHandL);
    case Bone::kFingersL:
      return std::string("fingers") + end;
    case Bone::kFingertipsL:
      return std::string("fingertips") + end;
    case Bone::kThumbL:
      return std::string("thumb") + end;
    case Bone::kThighL:
      return common(JointId::kThighL);
    case Bone::kCalfL:
      return common(JointId::kCalfL);
    case Bone::kFootL:
      return common(JointId::kFootL);
    default:
      return common(JointId::kToesL);
  }
}

/// Takes the axes of the body to those of a bone of the rest pose, where arms and legs are spread.
Mat3 rest_frame(Bone bone) {
  const bool of_arm = bone >= Bone::kUpperArmL && bone <= Bone::kThumbR;
  const bool of_leg = bone >= Bone::kThighL && bone <= Bone::kCalfR;
  if (!of_arm && !of_leg) return Mat3::Identity();
  const double sign = (index(bone) - index(Bone::kClavicleL)) % 2 == 0 ? 1.0 : -1.0;
  const double spread_rad = of_arm ? Figure::kArmDrop_rad : Figure::kLegSpread_rad;
  return Eigen::AngleAxisd(sign * spread_rad, Vec3::UnitZ()).toRotationMatrix();
}

}  // namespace

rig::Skeleton true_skeleton(const BoneTransforms& bones, const std::vector<Joint>& joints) {
  rig::Skeleton skeleton;
  for (int b = 0; b < kBoneCount; ++b) {
    const auto bone = static_cast<Bone>(b);
    const int above = index(parent(bone));
    rig::Joint joint;
    joint.name = rig_name(bone);
    joint.parent = above == b ? rig::kNoParent : above;
    joint.bind = rig::affine(bones[b].linear() * rest_frame(bone), joints[b].position);
    joint.local = rig::to_local_transform(
        above == b ? joint.bind : rig::compose(rig::inverse(skeleton.joints[above].bind), joint.bind));
    skeleton.joints.push_back(std::move(joint));
  }
  return skeleton;
}

rig::SkinWeights sparse_weights(const std::vector<BoneWeights>& weights) {
  rig::SkinWeights sparse;
  sparse.first.reserve(weights.size() + 1);
  sparse.first.push_back(0);
  for (const BoneWeights& w : weights) {
    float sum = 0.0f;
    for (int b = 0; b < kBoneCount; ++b) sum += w[b] >= kLeastWeight ? w[b] : 0.0f;
    for (int b = 0; b < kBoneCount; ++b) {
      if (w[b] < kLeastWeight) continue;
      sparse.joint.push_back(static_cast<std::uint16_t>(b));
      sparse.weight.push_back(w[b] / sum);
    }
    sparse.first.push_back(static_cast<std::uint32_t>(sparse.joint.size()));
  }
  return sparse;
}

}  // namespace bodice::synth
