#include "moving_body.hpp"

#include <bodice/engine/message.hpp>

namespace bodice::tryon {

using geometry::Vec3;

engine::Result<MovingBody> MovingBody::make(const PreparedBody& body, const BodyMotion* motion, double ramp_s,
                                            bool loop) {
  MovingBody moving(body);
  if (!motion) return moving;
  auto poser = binding::Poser::make(body.fit.proxy);
  if (!poser) return std::move(poser).error();
  moving.poser_.emplace(std::move(poser).value());
  moving.motion_ = motion;
  moving.player_.emplace(*motion, ramp_s, loop ? rig::Playback::kLoop : rig::Playback::kClamp);
  moving.joints_.resize(motion->rig.skeleton.joints.size());
  moving.skinning_.resize(moving.joints_.size());
  moving.posed_ = body.skin.input.skin;
  return moving;
}

engine::Result<void> MovingBody::pose(const engine::Context& context, double time_s, double dt_s) {
  if (!moves()) return {};
  player_->joints(time_s, joints_);
  if (auto posed = poser_->pose(context, joints_); !posed) return posed;
  if (!collider_.pose(poser_->posed(), dt_s))
    return engine::Error{engine::ErrorCode::kUnusableGeometry,
                         engine::message("At second ", time_s, " of the clip '", motion_->clip.name,
                                         "' the body has no shape that a collider takes."),
                         "Check the scales of the clip."};
  rig::skinning_matrices(motion_->rig.skeleton, joints_, skinning_);
  rig::skin_linear(context, body_->skin.input.skin.positions, motion_->rig.weights, skinning_,
                   posed_.positions);
  distance_.reset();
  return {};
}

const geometry::MeshDistance& MovingBody::distance(const engine::Context& context) {
  if (!moves()) return *body_->skin.distance;
  if (!distance_) distance_.emplace(context, posed_);
  return *distance_;
}

void MovingBody::carry(std::span<const Vec3> bound, const rig::SkinWeights& weights,
                       std::span<Vec3> posed) const {
  rig::skin_linear(bound, weights, skinning_, posed);
}

}  // namespace bodice::tryon
