#include "bind/bends.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

namespace bodice::inline v0_1::binding {
namespace {

using body::Part;

/// Share of a part's skin that its joint must carry, with the joints below it.
constexpr double kCarries = 0.85;
/// A limb that points farther from where a straight one does is bent enough.
constexpr double kBent_deg = 25.0;

constexpr double radians(double degrees) {
  return degrees / 180.0 * std::numbers::pi;
}

using PartWeights = std::array<double, body::kAllPartCount>;

/// For each joint how much of each part it carries with the joints below it, 0 to 1.
std::vector<PartWeights> carried_parts(const SkinnedBody& body, std::span<const Part> part) {
  const auto& joints = body.skeleton.joints;
  std::vector<PartWeights> carried(joints.size(), PartWeights{});
  PartWeights all{};
  for (std::size_t t = 0; t < body.skin.triangles.size(); ++t) {
    const double area = geometry::area_vector(body.skin, t).norm();
    for (const geometry::Index v : body.skin.triangles[t]) {
      const auto p = static_cast<std::size_t>(part[v]);
      all[p] += area;
      for (std::uint32_t i = body.weights.first[v]; i < body.weights.first[v + 1]; ++i)
        carried[body.weights.joint[i]][p] += area * static_cast<double>(body.weights.weight[i]);
    }
  }
  for (std::size_t j = joints.size(); j-- > 0;)
    for (std::size_t p = 0; p < all.size() && joints[j].parent >= 0; ++p)
      carried[static_cast<std::size_t>(joints[j].parent)][p] += carried[j][p];
  for (PartWeights& weights : carried)
    for (std::size_t p = 0; p < all.size(); ++p) weights[p] = all[p] > 0.0 ? weights[p] / all[p] : 0.0;
  return carried;
}

/// The last joint of the hierarchy that carries a part.
std::optional<std::size_t> joint_of(const std::vector<PartWeights>& carried, Part part) {
  std::optional<std::size_t> found;
  double least = 2.0 * body::kAllPartCount;
  for (std::size_t j = 0; j < carried.size(); ++j) {
    if (carried[j][static_cast<std::size_t>(part)] < kCarries) continue;
    double sum = 0.0;
    for (const double weight : carried[j]) sum += weight;
    if (sum > least) continue;
    least = sum;
    found = j;
  }
  return found;
}

/// The middle of each part's vertices.
std::vector<Vec3> centroids(const SkinnedBody& body, std::span<const Part> part) {
  std::vector<Vec3> sum(body::kAllPartCount, Vec3::Zero());
  std::vector<double> count(body::kAllPartCount, 0.0);
  for (std::size_t v = 0; v < part.size(); ++v) {
    const auto p = static_cast<std::size_t>(part[v]);
    sum[p] += body.skin.positions[v];
    count[p] += 1.0;
  }
  for (std::size_t p = 0; p < sum.size(); ++p)
    if (count[p] > 0.0) sum[p] /= count[p];
  return sum;
}

/// The turn of a joint's frame, or none.
std::optional<Mat3> turn_of(const Bend& bend, const Vec3& head, const Vec3& middle,
                            const std::optional<Vec3>& straight) {
  const Vec3 along = (middle - head).stableNormalized();
  if (straight && along.dot(straight->stableNormalized()) < std::cos(radians(kBent_deg))) return std::nullopt;
  const Vec3 axis = along.cross(bend.toward);
  // A limb that points there already has nowhere to bend.
  if (axis.norm() < std::sin(radians(kBent_deg))) return std::nullopt;
  return Eigen::AngleAxisd(radians(bend.degrees), axis.normalized()).toRotationMatrix();
}

}  // namespace

Limbs::Limbs(const SkinnedBody& body, std::span<const Part> part)
    : skeleton_(body.skeleton), centroid_(centroids(body, part)) {
  const std::vector<PartWeights> carried = carried_parts(body, part);
  for (std::size_t p = 0; p < body::kAllPartCount; ++p)
    joint_.push_back(joint_of(carried, static_cast<Part>(p)));
  directions_.up = Vec3::UnitY();
  directions_.left = centroid(Part::kThighL) - centroid(Part::kThighR);
  directions_.front = directions_.left.cross(directions_.up).stableNormalized();
}

std::optional<std::vector<rig::Affine>> Limbs::bent(std::span<const Bend> bends) const {
  const auto& joints = skeleton_.joints;
  std::vector<std::optional<Mat3>> turns(joints.size());
  bool any = false;
  for (const Bend& bend : bends) {
    const auto joint = joint_[static_cast<std::size_t>(bend.part)];
    if (!joint || turns[*joint]) continue;
    const Vec3 head = joints[*joint].bind.col(3);
    std::optional<Vec3> straight;
    if (bend.straight_from == bend.part) {
      if (bend.part == Part::kThighL || bend.part == Part::kThighR) straight = -directions_.up;
    } else {
      straight = head - centroid(bend.straight_from);
    }
    turns[*joint] = turn_of(bend, head, centroid(bend.part), straight);
    any = any || turns[*joint];
  }
  if (!any) return std::nullopt;
  std::vector<rig::Affine> skinning;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const Vec3 head = joints[j].bind.col(3);
    const Mat3 turn = turns[j].value_or(Mat3::Identity());
    const rig::Affine own = rig::affine(turn, head - turn * head);
    skinning.push_back(
        joints[j].parent < 0 ? own : rig::compose(skinning[static_cast<std::size_t>(joints[j].parent)], own));
  }
  return skinning;
}

}  // namespace bodice::binding
