#include "motion/moving_body.hpp"

#include <algorithm>

#include <bodice/engine/message.hpp>
#include <bodice/proxy/add_things.hpp>

namespace bodice::tryon {

using geometry::Vec3;

engine::Result<MovingBody> MovingBody::make(const SegmentedSkin& skin, const proxy::BodyProxy& proxy,
                                            bool moves) {
  MovingBody moving(skin, proxy);
  if (!moves) return moving;
  if (!skin.rig)
    return engine::Error{engine::ErrorCode::kInvalidArgument, "The body has no rig that could move it.",
                         "Read a body that has one, or give it one with tryon::give_rig()."};
  auto poser = binding::Poser::make(proxy);
  if (!poser) return std::move(poser).error();
  const std::size_t joints = skin.rig->skeleton.joints.size();
  const bool has_still =
      poser->joints() == joints + 1 && proxy.binding()->joint_names.back() == proxy::kStillJoint;
  if (poser->joints() != joints && !has_still)
    return engine::Error{engine::ErrorCode::kInvalidArgument,
                         engine::message("The body's rig has ", joints, " joints, but its proxy is bound to ",
                                         poser->joints(), "."),
                         "Bind the proxy to the rig that moves the skin."};
  moving.poser_.emplace(std::move(poser).value());
  moving.skinning_.assign(joints, rig::identity());
  if (has_still) moving.with_still_.assign(joints + 1, rig::identity());
  moving.posed_ = skin.input.skin;
  moving.is_skinned_ = true;
  return moving;
}

engine::Result<void> MovingBody::pose(const engine::Context& context, std::span<const rig::Affine> joints,
                                      double dt_s, const binding::PoseOptions& options) {
  if (!moves()) return {};
  std::span<const rig::Affine> all = joints;
  if (!with_still_.empty() && joints.size() + 1 == with_still_.size()) {
    std::ranges::copy(joints, with_still_.begin());
    all = with_still_;
  }
  if (auto posed = poser_->pose(context, all, options); !posed) return posed;
  if (!collider_.pose(poser_->posed(), dt_s))
    return engine::Error{engine::ErrorCode::kUnusableGeometry,
                         "In this pose the body has no shape that a collider takes.",
                         "Check the scales of the clip."};
  rig::skinning_matrices(skin_->rig->skeleton, joints, skinning_);
  is_skinned_ = false;
  distance_.reset();
  return {};
}

const geometry::TriMesh& MovingBody::skin(const engine::Context& context) {
  if (!moves()) return skin_->input.skin;
  if (!is_skinned_)
    rig::skin_linear(context, skin_->input.skin.positions, skin_->rig->weights, skinning_, posed_.positions);
  is_skinned_ = true;
  return posed_;
}

const geometry::MeshDistance& MovingBody::distance(const engine::Context& context) {
  if (!moves()) return *skin_->distance;
  if (!distance_) distance_.emplace(context, skin(context));
  return *distance_;
}

void MovingBody::carry(std::span<const Vec3> bound, const rig::SkinWeights& weights,
                       std::span<Vec3> posed) const {
  rig::skin_linear(bound, weights, skinning_, posed);
}

}  // namespace bodice::tryon
