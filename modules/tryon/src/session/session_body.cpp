#include "session/session_body.hpp"

#include <utility>

namespace bodice::tryon {
namespace {

std::shared_ptr<const SessionMotion> motion_of(std::uint64_t number,
                                               std::shared_ptr<const SegmentedSkin> skin,
                                               std::shared_ptr<const BodyMotion> motion, double ramp_s,
                                               rig::Playback mode) {
  auto playback = std::make_shared<ClipPlayback>(std::move(motion), mode);
  return std::make_shared<const SessionMotion>(
      SessionMotion{number, std::move(skin), std::move(playback), ramp_s, mode});
}

}  // namespace

engine::Result<std::shared_ptr<const SessionBody>> make_session_body(
    LiveBody live, bool moves, std::shared_ptr<const SessionMotion> motion) {
  auto body = MovingBody::make(*live.skin, live.proxy, moves);
  if (!body) return std::move(body).error();
  auto ready =
      std::make_shared<SessionBody>(SessionBody{.live = std::move(live), .motion = std::move(motion)});
  ready->body = std::make_shared<MovingBody>(std::move(body).value());
  ready->origin = ready->live.skin;
  ready->origin_proxy = std::make_shared<const proxy::BodyProxy>(ready->live.proxy);
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
  return motion_of(wanted.number, skin, std::make_shared<const BodyMotion>(std::move(found).value()), ramp_s,
                   wanted.options.loop ? rig::Playback::kLoop : rig::Playback::kClamp);
}

engine::Result<std::shared_ptr<const SessionBody>> make_reshaped(const engine::Context& context,
                                                                 const SessionBody& body,
                                                                 const SessionMotion* motion,
                                                                 std::span<const geometry::Vec3> positions) {
  auto shape = reshape_body(context, *body.origin, *body.origin_proxy, positions);
  if (!shape) return std::move(shape).error();
  std::shared_ptr<const SessionMotion> same;
  if (motion)
    same = motion_of(
        motion->number, shape->skin,
        std::make_shared<const BodyMotion>(BodyMotion{*shape->skin->rig, motion->playback->motion().clip}),
        motion->ramp_s, motion->mode);
  auto ready = make_session_body({shape->skin, shape->proxy, body.live.refinement}, body.body->moves(),
                                 std::move(same));
  if (!ready) return ready;
  auto whole = std::make_shared<SessionBody>(**ready);
  whole->origin = body.origin;
  whole->origin_proxy = body.origin_proxy;
  return std::shared_ptr<const SessionBody>(std::move(whole));
}

}  // namespace bodice::tryon
