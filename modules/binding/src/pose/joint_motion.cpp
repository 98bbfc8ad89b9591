#include "pose/joint_motion.hpp"

#include <cmath>

#include <Eigen/LU>

#include "pose/svd3.hpp"
#include "tolerances.hpp"

namespace bodice::binding {
namespace {

using proxy::JointMatrix;

/// A rotation times a scale, nearest to a matrix that is nearly one.
struct Similarity {
  Eigen::Matrix3d rotation;
  double scale = 1.0;
  std::string_view reason;  ///< why there is none; empty: there is one
};

Similarity similarity_of(const JointMatrix& map) {
  Similarity found;
  if (!map.allFinite()) return {{}, 0.0, "is not finite"};
  const Eigen::Matrix3d linear = map.leftCols<3>();
  const double volume = linear.determinant();
  const double size = linear.cwiseAbs().maxCoeff();
  if (!(size > 0.0)) return {{}, 0.0, "has no extent"};
  if (volume < 0.0) return {{}, 0.0, "mirrors"};
  found.scale = std::cbrt(volume);
  if (!(found.scale >= kLeastScale * (1.0 - kScaleRounding)))
    return {{}, 0.0, size < kLeastScale ? "has nearly no extent" : "is flat"};
  if (!(found.scale <= kMostScale * (1.0 + kScaleRounding))) return {{}, 0.0, "is larger than a million"};
  const Eigen::Matrix3d unit = linear / found.scale;
  const double drift = (unit.transpose() * unit - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!(drift <= kDrift)) return {{}, 0.0, "shears, or scales its axes unlike"};
  found.rotation = polar_rotation(unit);
  return found;
}

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
    const Similarity found = similarity_of(map);
    if (!found.reason.empty()) return Refusal{j, found.reason};
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
