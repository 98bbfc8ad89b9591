#include "pose/base_mix.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "pose/svd3.hpp"
#include "tolerances.hpp"

namespace bodice::inline v0_1::binding {
namespace {

Eigen::Matrix3f without_scale(const Eigen::Matrix3f& linear) {
  const float size = std::cbrt(linear.determinant());
  return linear / (size > 0.0f ? size : 1.0f);
}

/// The joints that move more than kLeastTurning of an ellipsoid's center, that of the most first.
std::vector<std::uint16_t> main_joints(const proxy::BodyProxy& bound, std::size_t k) {
  const proxy::Binding& binding = *bound.binding();
  const Eigen::Vector4d center = bound.ellipsoids()[k].shape.center.homogeneous();
  std::vector<std::pair<double, std::uint16_t>> found;
  for (std::size_t i = binding.first_term[k]; i < binding.first_term[k + 1]; ++i) {
    const Eigen::Map<const Eigen::Matrix4d> m(binding.terms[i].matrix.data());
    const double weight = m.row(3).dot(center);
    if (weight > kLeastTurning) found.emplace_back(weight, binding.terms[i].joint);
  }
  if (found.empty()) found.emplace_back(1.0, binding.terms[binding.first_term[k]].joint);
  std::ranges::stable_sort(found, [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<std::uint16_t> joints;
  for (const auto& [weight, joint] : found) joints.push_back(joint);
  return joints;
}

/// Largest squared chord between the joints of a pose and of a base; no rotations: the pose at rest.
double squared_chord(std::span<const std::uint16_t> joints, std::span<const Eigen::Matrix3f> pose,
                     const Eigen::Matrix3f* base) {
  double largest = 0.0;
  const Eigen::Matrix3f& main = pose[joints.front()];
  for (const std::uint16_t joint : joints.subspan(1)) {
    const Eigen::Matrix3f turned = main.transpose() * pose[joint];
    const float squared = base ? (turned - base[joints.front()].transpose() * base[joint]).squaredNorm()
                               : (turned - Eigen::Matrix3f::Identity()).squaredNorm();
    largest = std::max(largest, 0.5 * static_cast<double>(squared));
  }
  return largest;
}

}  // namespace

BaseMix::BaseMix(const proxy::BodyProxy& bound) : bound_(bound) {
  for (const proxy::JointMatrix& bind : bound.binding()->bind)
    to_joint_.push_back(Eigen::Matrix3f(bind.leftCols<3>().inverse().cast<float>()));
  rotation_.assign(to_joint_.size(), Eigen::Matrix3f::Identity());
  other_ = rotation_;
  for (std::size_t k = 0; k < bound.ellipsoids().size(); ++k) joints_.push_back(main_joints(bound, k));
}

std::size_t BaseMix::least_used() const {
  std::size_t found = bases_.size();
  float least = 0.0f;
  for (std::size_t b = 0; b < bases_.size(); ++b) {
    if (bases_[b].stays) continue;
    float used = 0.0f;
    for (std::size_t k = 0; k < joints_.size(); ++k) used += share(k, b);
    if (found < bases_.size() && used >= least) continue;
    found = b;
    least = used;
  }
  return found;
}

void BaseMix::add(std::shared_ptr<const proxy::BasePose> pose, int poses, bool stays) {
  const auto passing = [](const Base& base) { return !base.stays; };
  if (!stays && static_cast<std::size_t>(std::ranges::count_if(bases_, passing)) >= kMostPassing)
    bases_.erase(bases_.begin() + static_cast<std::ptrdiff_t>(least_used()));
  Base base{std::move(pose), {}, poses > 0 ? 0.0 : 1.0, poses > 0 ? 1.0 / poses : 0.0, stays};
  base.rotation.resize(to_joint_.size());
  take(base.pose->joints, base.rotation);
  bases_.push_back(std::move(base));
  shares_.assign(joints_.size() * (bases_.size() + 1), 0.0f);
  value_.resize(bases_.size() + 1);
}

void BaseMix::take(std::span<const proxy::JointMatrix> world, std::span<Eigen::Matrix3f> rotation) const {
  for (std::size_t j = 0; j < rotation.size(); ++j)
    rotation[j] = without_scale(world[j].leftCols<3>().cast<float>() * to_joint_[j]);
}

double BaseMix::departure(std::span<const proxy::JointMatrix> world) {
  take(world, other_);
  double largest = 0.0;
  for (const auto& joints : joints_) {
    double nearest = squared_chord(joints, other_, nullptr);
    for (const Base& base : bases_)
      nearest = std::min(nearest, squared_chord(joints, other_, base.rotation.data()));
    largest = std::max(largest, nearest);
  }
  return std::sqrt(largest);
}

void BaseMix::add_shares(std::size_t k, bool all, float weight) {
  const std::size_t first = k * (bases_.size() + 1);
  double sum = 0.0;
  for (std::size_t b = 0; b <= bases_.size(); ++b) {
    value_[b] = 0.0;
    if (b > 0 && !all && bases_[b - 1].presence < 1.0) continue;
    const Eigen::Matrix3f* const base = b == 0 ? nullptr : bases_[b - 1].rotation.data();
    const double softened = squared_chord(joints_[k], rotation_, base) + kSameTurn_rad * kSameTurn_rad;
    value_[b] = 1.0 / (softened * softened);
    sum += value_[b];
  }
  // A share that is too small to be seen is cut, without a step, so that most tables are read once or twice.
  double left = 0.0;
  for (std::size_t b = 0; b <= bases_.size(); ++b) {
    value_[b] = std::max(0.0, value_[b] / sum - double{kLeastShare});
    left += value_[b];
  }
  for (std::size_t b = 0; b <= bases_.size(); ++b)
    shares_[first + b] += weight * static_cast<float>(value_[b] / left);
}

void BaseMix::find(std::span<const proxy::JointMatrix> skinning) {
  if (bases_.empty()) return;
  for (Base& base : bases_) base.presence = std::min(1.0, base.presence + base.more_each_pose);
  for (std::size_t j = 0; j < skinning.size(); ++j)
    rotation_[j] = without_scale(skinning[j].leftCols<3>().cast<float>());
  float present = 1.0f;
  for (const Base& base : bases_) present = std::min(present, static_cast<float>(base.presence));
  std::fill(shares_.begin(), shares_.end(), 0.0f);
  for (std::size_t k = 0; k < joints_.size(); ++k) {
    add_shares(k, true, present);
    if (present < 1.0f) add_shares(k, false, 1.0f - present);
  }
}

}  // namespace bodice::binding
