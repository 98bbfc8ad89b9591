#include <bodice/tryon/session.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include <bodice/engine/message.hpp>

#include "session/session_impl.hpp"

namespace bodice::inline v0_1::tryon {
namespace {

using geometry::Vec3;
using BodySink = engine::Sink<SessionBody>;

/// Publishes each proxy of a body together with everything that frames need, so that a frame only copies a
/// pointer. The clip that was requested when the body was submitted is found once.
class BodyPublisher {
 public:
  BodyPublisher(const engine::Context& context, BodySink& sink, bool moves, WantedClip wanted, Worn worn)
      : context_(context), sink_(sink), moves_(moves), wanted_(std::move(wanted)), worn_(std::move(worn)) {}

  void publish(const std::shared_ptr<const SegmentedSkin>& skin, const proxy::BodyProxy& proxy) {
    if (moves_ && wanted_.number > 0 && !motion_ && result) {
      auto found = find_session_motion(context_, skin, wanted_);
      if (found)
        motion_ = std::move(found).value();
      else
        result = std::move(found).error();
    }
    auto body = make_session_body(context_, {skin, proxy, next_++}, moves_, motion_, worn_);
    if (body)
      sink_.publish(std::move(body).value());
    else if (result)
      result = std::move(body).error();
  }

  engine::Result<void> result;  ///< the first error that did not stop the preparation

 private:
  const engine::Context& context_;
  BodySink& sink_;
  bool moves_;
  WantedClip wanted_;
  Worn worn_;
  std::shared_ptr<const SessionMotion> motion_;
  int next_ = 0;
};

engine::Error cannot_move() {
  return {engine::ErrorCode::kInvalidArgument, "The bodies of this session do not move.",
          "Make it with SessionOptions::moves."};
}

}  // namespace

Session::Session(const engine::Context& context, SessionOptions options)
    : impl_(std::make_unique<Impl>(context, std::move(options))) {}

Session::~Session() = default;

engine::Ticket Session::submit(BodySource source) {
  PreparationOptions options{
      .segment = impl_->options.segment, .fit = impl_->options.fit, .bind = impl_->options.moves};
  if (impl_->options.region_margin_m && impl_->solver) {
    options.garments = {impl_->wardrobe->mesh};
    options.region_margin_m = *impl_->options.region_margin_m;
  }
  return impl_->bodies.submit(
      "prepare body",
      [source = std::move(source), options = std::move(options), wanted = impl_->wanted,
       worn = impl_->worn()](const engine::Context& context, BodySink& sink) -> engine::Result<void> {
        BodyPublisher publisher(context, sink, options.bind, wanted, worn);
        auto preparation = Preparation::make(
            options, [&](const auto& skin, const auto& proxy) { publisher.publish(skin, proxy); });
        if (!preparation) return std::move(preparation).error();
        if (auto done = preparation->run(context, source); !done) return done;
        return publisher.result;
      });
}

engine::Result<void> Session::dress(const std::vector<WornGarment>& garments) {
  auto all = join(garments);
  if (!all) return std::move(all).error();
  const auto fabric = fabric_or_cotton(impl_->options.fabric);
  if (!fabric) return fabric.error();
  auto solver = cloth::Solver::make(all->mesh, all->held, *fabric, impl_->options.solver);
  if (!solver) return std::move(solver).error();
  impl_->solver.emplace(std::move(solver).value());
  impl_->wardrobe = std::make_shared<const Wardrobe>(std::move(all).value());
  impl_->held = nullptr;
  impl_->cloth = impl_->wardrobe->mesh.positions;
  impl_->reach.emplace(impl_->cloth);
  if (impl_->motion) {  // garments are made for the bind pose
    ClipPlayback& playback = *impl_->motion->playback;
    playback.start_from_bind(playback.time_s(), impl_->motion->ramp_s);
    impl_->jumped = true;
  }
  return {};
}

engine::Ticket Session::play(MotionChoice choice, const PlayOptions& options) {
  Impl& s = *impl_;
  if (!s.options.moves)
    return s.motions.submit(
        "find clip", [](const engine::Context&, auto&) -> engine::Result<void> { return cannot_move(); });
  s.wanted = {s.wanted.number + 1, std::move(choice), options};
  s.paused = false;
  return s.body && s.body->body->moves() ? s.find_wanted_clip() : engine::Ticket{};
}

void Session::pause() noexcept {
  impl_->paused = true;
}

void Session::resume() noexcept {
  impl_->paused = false;
}

void Session::seek(double time_s, double ramp_s) {
  if (!impl_->motion) return;
  impl_->motion->playback->seek(time_s, ramp_s);
  impl_->jumped = impl_->jumped || !(ramp_s > 0.0);
}

engine::Result<void> Session::reshape(std::vector<Vec3> positions) {
  if (!impl_->body)
    return engine::Error{engine::ErrorCode::kInvalidArgument, "There is no body that could take a shape.",
                         "Wait for the first one."};
  if (auto good = check_shape(*impl_->body->origin, positions); !good) return good;
  impl_->wanted_shape = std::move(positions);
  impl_->begin_shape();
  return {};
}

FrameOutcome Session::frame(double dt_s) {
  Impl& s = *impl_;
  s.begin_shape();
  if (s.nothing_runs_behind) s.pipeline.run_pending();
  FrameOutcome outcome;
  outcome.timing = s.pipeline.frame([&](const engine::Context& context) {
    s.take_results(outcome);
    outcome.has_body = s.body != nullptr;
    if (!s.body) return;  // otherwise garments would fall to the floor before the first body is ready
    outcome.proxy_hash = s.body->live.proxy.hash();
    if (s.solver && !s.held) s.hold_garments(context);
    s.pose(context, dt_s);
    if (s.solver) outcome.cloth = s.solver->step(context, s.body->body->collider(), dt_s);
  });
  if (s.motion && s.body && s.motion->skin == s.body->live.skin) {
    outcome.plays = true;
    outcome.clip_s = s.motion->playback->time_s();
    outcome.ramp_left_s = s.motion->playback->ramp_left_s();
    // While a slider moves, a refit would be for a shape that is about to be replaced.
    const bool keeps_shape = s.shapes_done == s.shapes_begun && s.wanted_shape.empty();
    if (s.options.refits && !s.nothing_runs_behind && keeps_shape)
      s.refits.begin_if_needed(s.body->live.skin, s.body->live.proxy, *s.body->body, *s.motion->playback,
                               s.paused);
  }
  return outcome;
}

const LiveBody* Session::body() const noexcept {
  return impl_->body ? &impl_->body->live : nullptr;
}

void Session::skin_positions(std::span<Vec3> out) const {
  if (!impl_->body) return;
  impl_->body->body->skin_positions(out);
}

const collision::Collider* Session::collider() const noexcept {
  return impl_->body ? &impl_->body->body->collider() : nullptr;
}

const proxy::PosedProxy* Session::posed() const noexcept {
  return impl_->body && impl_->body->body->moves() ? &impl_->body->body->poser()->posed() : nullptr;
}

std::size_t Session::vertices() const noexcept {
  return impl_->wardrobe ? impl_->wardrobe->mesh.positions.size() : 0;
}

void Session::positions(std::span<Vec3> out) const {
  if (impl_->solver) impl_->solver->positions(out);
}

std::uint64_t Session::hash() const noexcept {
  return impl_->solver ? impl_->solver->hash() : 0;
}

engine::FramePipeline& Session::pipeline() noexcept {
  return impl_->pipeline;
}

}  // namespace bodice::tryon
