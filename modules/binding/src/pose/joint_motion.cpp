#include "pose/joint_motion.hpp"

#include <cmath>

#include <Eigen/LU>

#include <bodice/geometry/similarity.hpp>

namespace bodice::inline v0_1::binding {
namespace {

using proxy::JointMatrix;

}  // namespace

JointMotion::JointMotion(const proxy::Binding& binding)
    : moves_skin_(binding.bind.size(), 0),
      skinning_(binding.bind.size(), JointMatrix::Identity()),
      trial_(skinning_) {
  for (const proxy::CarryTerm& term : binding.terms) moves_skin_[term.joint] = 1;
  for (const JointMatrix& bind : binding.bind) {
    JointMatrix inverse;
    inverse.leftCols<3>() = bind.leftCols<3>().inverse();
    inverse.col(3) = -(inverse.leftCols<3>() * bind.col(3));
    to_joint_.push_back(inverse);
    head_.push_back(bind.col(3));
  }
}

std::optional<Refusal> JointMotion::take(std::span<const JointMatrix> world) {
  double logs = 0.0, count = 0.0;
  for (std::size_t j = 0; j < skinning_.size(); ++j) {
    if (!moves_skin_[j]) continue;
    JointMatrix map;
    map.leftCols<3>() = world[j].leftCols<3>() * to_joint_[j].leftCols<3>();
    map.col(3) = world[j].col(3);
    if (!map.col(3).allFinite()) return Refusal{j, "is not finite"};
    const geometry::Similarity found = geometry::similarity_of(map.leftCols<3>());
    if (!found.refusal.empty()) return Refusal{j, found.refusal};
    // The joint's own origin is where the matrix has it; what was mended turns about it.
    trial_[j].leftCols<3>() = found.scale * found.rotation;
    trial_[j].col(3) = world[j].col(3) - trial_[j].leftCols<3>() * head_[j];
    logs += std::log(found.scale);
    count += 1.0;
  }
  skinning_.swap(trial_);
  scale_ = count > 0.0 ? std::exp(logs / count) : 1.0;
  return std::nullopt;
}

}  // namespace bodice::binding
