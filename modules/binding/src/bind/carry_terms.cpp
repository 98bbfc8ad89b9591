#include "bind/carry_terms.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <bodice/engine/random.hpp>

#include "tolerances.hpp"

namespace bodice::inline v0_1::binding {
namespace {

using Mat4 = Eigen::Matrix4d;
using Vec4 = Eigen::Vector4d;

constexpr int kTurnedPoses = 4;
constexpr double kTurn_rad = 25.0 / 180.0 * std::numbers::pi;

/// What one joint adds to the normal equations.
struct Share {
  Mat4 moment = Mat4::Zero();  ///< sum of weight * skin weight * s s^T, s = (p - center, 1)
  double weight = 0.0;
};

Mat4 shift(const Vec3& by) {
  Mat4 map = Mat4::Identity();
  map.topRightCorner<3, 1>() = by;
  return map;
}

Vec3 random_axis(const engine::Random& random, std::uint64_t index) {
  const double z = 2.0 * random.uniform_at(2 * index) - 1.0;
  const double angle = 2.0 * std::numbers::pi * random.uniform_at(2 * index + 1);
  const double r = std::sqrt(std::max(0.0, 1.0 - z * z));
  return {r * std::cos(angle), r * std::sin(angle), z};
}

}  // namespace

std::vector<proxy::CarryTerm> carry_terms(const geometry::Ellipsoid& shape, const SkinnedBody& body,
                                          std::span<const OwnedVertex> owned) {
  std::map<std::uint16_t, Share> shares;
  Mat4 moment = Mat4::Zero();
  double total = 0.0;
  const rig::SkinWeights& weights = body.weights;
  for (const OwnedVertex& o : owned) {
    const Vec4 s = (body.skin.positions[o.vertex] - shape.center).homogeneous();
    const Mat4 outer = o.weight * s * s.transpose();
    moment += outer;
    total += o.weight;
    // Floats that sum to 1 but for rounding would leave the body a millimeter behind, 10 km away.
    const std::uint32_t begin = weights.first[o.vertex], end = weights.first[o.vertex + 1];
    const double sum = std::accumulate(weights.weight.begin() + begin, weights.weight.begin() + end, 0.0);
    for (std::uint32_t i = begin; i < end; ++i) {
      Share& share = shares[weights.joint[i]];
      const double weight = static_cast<double>(weights.weight[i]) / sum;
      share.moment += weight * outer;
      share.weight += weight * o.weight;
    }
  }
  Mat4 ridge = Mat4::Zero();
  ridge.topLeftCorner<3, 3>() = shape.axes * shape.radii.cwiseAbs2().asDiagonal() * shape.axes.transpose();
  ridge *= kBlendRidge * total;
  ridge(3, 3) = 1e-6 * total;  // keeps a single vertex solvable
  const Mat4 solve = (moment + ridge).inverse();
  std::vector<std::pair<double, proxy::CarryTerm>> terms;
  for (const auto& [joint, share] : shares) {
    const Mat4 about_center = (share.moment + share.weight / total * ridge) * solve;
    proxy::CarryTerm term{joint, {}};
    Eigen::Map<Mat4>(term.matrix.data()) = shift(shape.center) * about_center * shift(-shape.center);
    terms.emplace_back(share.weight, term);
  }
  std::ranges::stable_sort(terms, [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<proxy::CarryTerm> sorted;
  for (const auto& [weight, term] : terms) sorted.push_back(term);
  return sorted;
}

rig::Affine carried(std::span<const proxy::CarryTerm> terms, std::span<const rig::Affine> skinning) {
  rig::Affine map = rig::Affine::Zero();
  for (const proxy::CarryTerm& term : terms) {
    const Eigen::Map<const Mat4> m(term.matrix.data());
    const rig::Affine& t = skinning[term.joint];
    map.noalias() += t.leftCols<3>() * m.topRows<3>();
    map.noalias() += t.col(3) * m.row(3);
  }
  return map;
}

std::vector<TurnedPose> turned_poses(const engine::Context& context, const SkinnedBody& body) {
  const engine::Random random(31);
  const auto& joints = body.skeleton.joints;
  std::vector<TurnedPose> poses(kTurnedPoses);
  for (std::size_t p = 0; p < poses.size(); ++p) {
    auto& [skinning, skin] = poses[p];
    for (std::size_t j = 0; j < joints.size(); ++j) {
      const Mat3 turn =
          Eigen::AngleAxisd(kTurn_rad, random_axis(random, p * joints.size() + j)).toRotationMatrix();
      const Vec3 head = joints[j].bind.col(3);
      const rig::Affine about_head = rig::affine(turn, head - turn * head);
      skinning.push_back(
          joints[j].parent < 0
              ? about_head
              : rig::compose(skinning[static_cast<std::size_t>(joints[j].parent)], about_head));
    }
    skin.resize(body.skin.positions.size());
    rig::skin_linear(context, body.skin.positions, body.weights, skinning, skin);
  }
  return poses;
}

double departure(std::span<const proxy::CarryTerm> terms, std::span<const TurnedPose> poses,
                 const SkinnedBody& body, std::span<const OwnedVertex> owned) {
  double sum = 0.0, total = 0.0;
  for (const TurnedPose& pose : poses) {
    const rig::Affine map = carried(terms, pose.skinning);
    for (const OwnedVertex& o : owned) {
      const Vec3 off = rig::apply(map, body.skin.positions[o.vertex]) - pose.skin[o.vertex];
      sum += o.weight * off.squaredNorm();
      total += o.weight;
    }
  }
  return std::sqrt(sum / total);
}

}  // namespace bodice::binding
