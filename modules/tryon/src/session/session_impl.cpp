#include "session/session_impl.hpp"

#include <utility>

namespace bodice::inline v0_1::tryon {

/// Finds the held vertices in the bind pose. They were found when the body was made, unless the garments have
/// changed since; finding them here allocates.
void Session::Impl::hold_garments(const engine::Context& context) {
  held = &body->held;
  if (held->of != wardrobe) {
    held_now = hold(context, worn(), *body->live.skin, *body->body);
    held = &held_now;
    jumped = true;
  }
  const bool goes_over = body->body->blend_share() > 0.0 && held_at_rest.size() == held->bind.size();
  held_before = goes_over ? held_at_rest : held->bind;
  held_at_rest = posed = held_before;
  solver->move_pins(posed);
}

/// Moves the held vertices with the body's shape and pose.
void Session::Impl::move_held() {
  const double share = body->body->blend_share();
  for (std::size_t i = 0; i < held_at_rest.size(); ++i)
    held_at_rest[i] = held->bind[i] + share * (held_before[i] - held->bind[i]);
  if (body->body->moves())
    body->body->carry(held_at_rest, held->weights, posed);
  else
    posed = held_at_rest;
  solver->move_pins(posed);
}

void Session::Impl::take_body(std::shared_ptr<const SessionBody> next) {
  if (body && body->origin_proxy == next->origin_proxy) {
    next->body->start_blend_from(*body->body);
    new_shape = true;
  } else {
    jumped = true;
  }
  body = std::move(next);
  held = nullptr;
  if (!body->body->moves() || wanted.number == 0) return;
  if (motion && motion->skin == body->live.skin && motion->number == wanted.number) return;
  if (body->motion && body->motion->number == wanted.number)
    take_motion(body->motion);
  else
    find_wanted_clip();
}

/// Starts a clip with its ramp, or continues at the time that another body had reached in the same clip.
void Session::Impl::take_motion(std::shared_ptr<const SessionMotion> next) {
  ClipPlayback& playback = *next->playback;
  const bool goes_on = motion && motion->number == next->number;
  const bool same_joints = motion && motion->skin == next->skin;
  if (goes_on) {
    playback.continue_from(*motion->playback);
  } else {
    playback.start_from_bind(0.0, next->ramp_s);
    if (same_joints) playback.start_from(motion->playback->joints(), 0.0, next->ramp_s);
  }
  motion = std::move(next);
}

engine::Ticket Session::Impl::find_wanted_clip() {
  return motions.submit(
      "find clip",
      [skin = body->live.skin, clip = wanted](const engine::Context& context,
                                              engine::Sink<SessionMotion>& sink) -> engine::Result<void> {
        auto found = find_session_motion(context, skin, clip);
        if (!found) return std::move(found).error();
        sink.publish(std::move(found).value());
        return {};
      });
}

void Session::Impl::begin_shape() {
  const bool waits = shapes_done < shapes_begun && !(reshape.done() && !reshape.wait());
  if (wanted_shape.empty() || !body || waits) return;
  const SessionMotion* const plays = motion && motion->skin == body->live.skin ? motion.get() : nullptr;
  reshape = shapes.submit(
      "reshape",
      [from = body, plays = plays ? motion : nullptr, number = ++shapes_begun, worn = worn(),
       shape = std::exchange(wanted_shape, {})](const engine::Context& context,
                                                engine::Sink<SessionShape>& sink) -> engine::Result<void> {
        auto reshaped = make_reshaped(context, *from, plays.get(), worn, shape);
        if (!reshaped && reshaped.error().code == engine::ErrorCode::kCanceled)
          return std::move(reshaped).error();
        if (!reshaped) context.warn(reshaped.error().sentence());
        sink.publish(
            std::make_shared<const SessionShape>(SessionShape{number, reshaped ? *reshaped : nullptr}));
        return {};
      });
}

/// Takes the bodies and shapes that streams have published until this frame.
void Session::Impl::take_results(FrameOutcome& outcome) {
  if (bodies.current() != seen_body) {
    seen_body = bodies.current();
    take_body(bodies.share());
  }
  if (shapes.current() != seen_shape) {
    seen_shape = shapes.current();
    shapes_done = seen_shape->number;
    if (seen_shape->body && body && seen_shape->body->origin == body->origin) take_body(seen_shape->body);
  }
  if (motions.current() != seen_motion) {
    seen_motion = motions.current();
    if (body && seen_motion->skin == body->live.skin && seen_motion->number == wanted.number)
      take_motion(motions.share());
  }
  if (motion && body && body->body->moves()) outcome.took_refit = refits.take(body->live.proxy, *body->body);
}

void Session::Impl::pose(const engine::Context& context, double dt_s) {
  MovingBody& moving = *body->body;
  if (!motion || motion->skin != body->live.skin) {
    if (!(moving.blend_share() > 0.0)) return;
    moving.advance_blend(dt_s);
    moving.show_shape(context);
    if (solver) move_held();
    return;
  }
  ClipPlayback& playback = *motion->playback;
  binding::PoseOptions where;
  if (solver) {
    solver->positions(cloth);
    where.within = reach->boxes(cloth);
  }
  // A new shape begins in the pose of the frame before, so that contacts have the velocity of its surface.
  if (std::exchange(new_shape, false) && !jumped)
    static_cast<void>(moving.pose(context, playback.joints(), 0.0, where));
  if (!paused) playback.advance(dt_s);
  moving.advance_blend(dt_s);
  // The surface has no velocity in a jump.
  if (auto done = moving.pose(context, playback.joints(), jumped ? 0.0 : dt_s, where); !done) return;
  jumped = false;
  if (solver) move_held();
}

}  // namespace bodice::tryon
