#include "session/session_impl.hpp"

#include <utility>

namespace bodice::tryon {

/// Pins are found in the bind pose. It may allocate, because it does not run in every frame.
void Session::Impl::hold_garments(const engine::Context& context) {
  held_by = body.get();
  if (body->body->moves()) {
    std::vector<rig::Affine> bind;
    for (const rig::Joint& joint : body->live.skin->rig->skeleton.joints) bind.push_back(joint.bind);
    static_cast<void>(body->body->pose(context, bind, 0.0));  // the bind pose has no matrix to refuse
    jumped = true;
  }
  held = held_positions(wardrobe, body->body->collider(), options.solver.thickness_m);
  posed = held;
  if (body->body->moves())
    held_weights = attach_to_skin(body->live.skin->input.skin, *body->live.skin->distance,
                                  body->live.skin->rig->weights, held);
  solver->move_pins(posed);
}

void Session::Impl::take_body(std::shared_ptr<const SessionBody> next) {
  body = std::move(next);
  jumped = true;
  held_by = nullptr;
  if (!body->body->moves() || wanted.number == 0) return;
  if (motion && motion->skin == body->live.skin && motion->number == wanted.number) return;
  if (body->motion && body->motion->number == wanted.number)
    take_motion(body->motion);
  else
    find_wanted_clip();
}

/// A clip begins with its ramp, or goes on where another body was in the same clip.
void Session::Impl::take_motion(std::shared_ptr<const SessionMotion> next) {
  ClipPlayback& playback = *next->playback;
  const bool goes_on = motion && motion->number == next->number;
  const bool same_joints = motion && motion->skin == next->skin;
  if (goes_on) {
    playback.go_on_as(*motion->playback);
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
  if (wanted_shape.empty() || !body || shapes_done < shapes_begun) return;
  const SessionMotion* const plays = motion && motion->skin == body->live.skin ? motion.get() : nullptr;
  shapes.submit(
      "reshape",
      [from = body, plays = plays ? motion : nullptr, number = ++shapes_begun,
       shape = std::exchange(wanted_shape, {})](const engine::Context& context,
                                                engine::Sink<SessionShape>& sink) -> engine::Result<void> {
        auto reshaped = make_reshaped(context, *from, plays.get(), shape);
        if (!reshaped && reshaped.error().code == engine::ErrorCode::kCanceled)
          return std::move(reshaped).error();
        sink.publish(
            std::make_shared<const SessionShape>(SessionShape{number, reshaped ? *reshaped : nullptr}));
        return {};
      });
}

/// What streams have brought to this boundary.
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
  if (!motion || motion->skin != body->live.skin) return;
  ClipPlayback& playback = *motion->playback;
  if (!paused) playback.advance(dt_s);
  binding::PoseOptions where;
  if (solver) {
    solver->positions(cloth);
    where.within = reach->boxes(cloth);
  }
  // A body that jumped here did not come with the velocity of the jump.
  if (auto done = body->body->pose(context, playback.joints(), jumped ? 0.0 : dt_s, where); !done) return;
  jumped = false;
  if (!solver) return;
  body->body->carry(held, held_weights, posed);
  solver->move_pins(posed);
}

}  // namespace bodice::tryon
