#include "session/session_body.hpp"

#include <utility>

#include <bodice/rig/loop.hpp>

namespace bodice::inline v0_1::tryon {
namespace {

/// The same clip on another shape of the body.
engine::Result<std::shared_ptr<const SessionMotion>> session_motion_of_shape(
    const engine::Context& context, const SessionMotion& before, std::shared_ptr<const SegmentedSkin> skin) {
  auto motion = motion_of_shape(context, *skin, before.choice, before.playback->motion());
  if (!motion) return std::move(motion).error();
  // A made motion is made anew. A seam of the same length keeps the time within the loop valid.
  const double seam_s = before.playback->motion().clip.duration_s - motion->clip.duration_s;
  if (before.mode == rig::Playback::kLoop) motion->clip = rig::close_loop(motion->clip, seam_s);
  auto same = std::make_shared<SessionMotion>(before);
  same->skin = std::move(skin);
  same->playback = std::make_shared<ClipPlayback>(
      std::make_shared<const BodyMotion>(std::move(motion).value()), before.mode);
  return std::shared_ptr<const SessionMotion>(std::move(same));
}

}  // namespace

HeldVertices hold(const engine::Context& context, const Worn& worn, const SegmentedSkin& skin,
                  MovingBody& body) {
  if (!worn.all) return {};
  if (body.moves()) body.show_shape(context);  // in the bind pose
  HeldVertices held{worn.all, held_positions(*worn.all, body.collider(), worn.thickness_m), {}};
  if (body.moves())
    held.weights = attach_to_skin(skin.input.skin, *skin.distance, skin.rig->weights, held.bind);
  return held;
}

engine::Result<std::shared_ptr<const SessionBody>> make_session_body(
    const engine::Context& context, LiveBody live, bool moves, std::shared_ptr<const SessionMotion> motion,
    const Worn& worn) {
  auto body = MovingBody::make(*live.skin, live.proxy, moves);
  if (!body) return std::move(body).error();
  auto ready =
      std::make_shared<SessionBody>(SessionBody{.live = std::move(live), .motion = std::move(motion)});
  ready->body = std::make_shared<MovingBody>(std::move(body).value());
  ready->origin = ready->live.skin;
  ready->origin_proxy = std::make_shared<const proxy::BodyProxy>(ready->live.proxy);
  ready->held = hold(context, worn, *ready->live.skin, *ready->body);
  return std::shared_ptr<const SessionBody>(std::move(ready));
}

engine::Result<std::shared_ptr<const SessionMotion>> find_session_motion(
    const engine::Context& context, const std::shared_ptr<const SegmentedSkin>& skin,
    const WantedClip& wanted) {
  std::vector<engine::Warning> warnings;
  auto found = find_motion(context, *skin, wanted.choice, warnings);
  if (!found) return std::move(found).error();
  const double ramp_s = wanted.options.ramp_s ? *wanted.options.ramp_s
                                              : suggested_ramp_s(context, *found, skin->input.skin.positions);
  const rig::Playback mode = wanted.options.loop ? rig::Playback::kLoop : rig::Playback::kClamp;
  if (wanted.options.loop) *found = closed_loop(context, *found, skin->input.skin.positions);
  auto playback =
      std::make_shared<ClipPlayback>(std::make_shared<const BodyMotion>(std::move(found).value()), mode);
  return std::make_shared<const SessionMotion>(
      SessionMotion{wanted.number, wanted.choice, skin, std::move(playback), ramp_s, mode});
}

engine::Result<std::shared_ptr<const SessionBody>> make_reshaped(const engine::Context& context,
                                                                 const SessionBody& body,
                                                                 const SessionMotion* motion,
                                                                 const Worn& worn,
                                                                 std::span<const geometry::Vec3> positions) {
  auto shape = reshape_body(context, *body.origin, *body.origin_proxy, positions);
  if (!shape) return std::move(shape).error();
  std::shared_ptr<const SessionMotion> same;
  if (motion) {
    auto found = session_motion_of_shape(context, *motion, shape->skin);
    if (!found) return std::move(found).error();
    same = std::move(found).value();
  }
  auto ready = make_session_body(context, {shape->skin, shape->proxy, body.live.refinement},
                                 body.body->moves(), std::move(same), worn);
  if (!ready) return ready;
  auto whole = std::make_shared<SessionBody>(**ready);
  whole->origin = body.origin;
  whole->origin_proxy = body.origin_proxy;
  return std::shared_ptr<const SessionBody>(std::move(whole));
}

}  // namespace bodice::tryon
