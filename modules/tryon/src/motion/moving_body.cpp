#include "motion/moving_body.hpp"

#include <algorithm>

#include <bodice/engine/message.hpp>
#include <bodice/proxy/add_things.hpp>

namespace bodice::inline v0_1::tryon {

using geometry::Vec3;

engine::Result<MovingBody> MovingBody::make(const SegmentedSkin& skin, const proxy::BodyProxy& proxy,
                                            bool moves) {
  MovingBody moving(skin, proxy);
  moving.collider_.cover({}, skin.input.skin.positions);
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
  for (const rig::Joint& joint : skin.rig->skeleton.joints) moving.bind_.push_back(joint.bind);
  moving.at_rest_ = skin.input.skin.positions;
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
  binding::PoseOptions between_shapes = options;
  between_shapes.offsets = blend_.offsets();
  between_shapes.offset_share = blend_.share();
  if (auto posed = poser_->pose(context, all, between_shapes); !posed) return posed;
  if (!collider_.pose(poser_->posed(), dt_s))
    return engine::Error{engine::ErrorCode::kUnusableGeometry,
                         "In this pose the body has no shape that a collider takes.",
                         "Check the scales of the clip."};
  rig::skinning_matrices(skin_->rig->skeleton, joints, skinning_);
  is_skinned_ = false;
  distance_.reset();
  cover(context, options.within);
  return {};
}

engine::Result<void> MovingBody::keep_bases(const proxy::BasePoses& bases) {
  for (const auto& base : bases) {
    const auto of_all =
        with_still_.empty()
            ? base
            : std::make_shared<const proxy::BasePose>(proxy::with_things(*base, poser_->bound()));
    if (auto kept = poser_->keep_base(of_all); !kept) return kept;
  }
  return {};
}

void MovingBody::cover(const engine::Context& context, std::optional<std::span<const geometry::Box>> within) {
  if (!collider_.has_relief()) return;
  if (blend_.share() > 0.0)
    skin_positions({});  // which poses the skin between two shapes
  else
    skin(context);
  collider_.cover(context, posed_.positions, {.within = within});
}

const geometry::TriMesh& MovingBody::skin(const engine::Context& context) {
  if (!moves()) return skin_->input.skin;
  if (!is_skinned_)
    rig::skin_linear(context, skin_->input.skin.positions, skin_->rig->weights, skinning_, posed_.positions);
  is_skinned_ = true;
  return posed_;
}

void MovingBody::skin_positions(std::span<Vec3> out) {
  const std::size_t count = std::min(out.size(), skin_->input.skin.positions.size());
  if (blend_.share() > 0.0 && moves()) {
    for (std::size_t v = 0; v < at_rest_.size(); ++v) at_rest_[v] = blend_.skin(v);
    rig::skin_linear(at_rest_, skin_->rig->weights, skinning_, posed_.positions);
    is_skinned_ = false;  // skin() is that of the body's own shape
    std::copy_n(posed_.positions.begin(), count, out.begin());
  } else if (blend_.share() > 0.0) {
    for (std::size_t v = 0; v < count; ++v) out[v] = blend_.skin(v);
  } else {
    std::copy_n(skin({}).positions.begin(), count, out.begin());
  }
}

void MovingBody::show_shape(const engine::Context& context) {
  if (moves())
    static_cast<void>(pose(context, bind_, 0.0));  // the bind pose has no matrix to refuse
  else
    collider_.move_to(blend_.shapes(), 0.0);
}

const geometry::MeshDistance& MovingBody::distance(const engine::Context& context) {
  if (!moves()) return *skin_->distance;
  if (!distance_) distance_.emplace(context, *skin_->distance, skin(context));
  return *distance_;
}

void MovingBody::carry(std::span<const Vec3> bound, const rig::SkinWeights& weights,
                       std::span<Vec3> posed) const {
  rig::skin_linear(bound, weights, skinning_, posed);
}

}  // namespace bodice::tryon
