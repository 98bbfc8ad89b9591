#include <bodice/tryon/session.hpp>

#include <optional>
#include <utility>

namespace bodice::tryon {
namespace {

using LiveStream = engine::Stream<LiveBody>;
using LiveSink = engine::Sink<LiveBody>;

/// Publishes each proxy with its collider, so that a frame only takes a pointer.
OnProxy publish_to(LiveSink& sink) {
  return [&sink, next = 0](const std::shared_ptr<const SegmentedSkin>& skin,
                           const proxy::BodyProxy& proxy) mutable {
    sink.publish(std::make_shared<const LiveBody>(LiveBody{
        .skin = skin, .proxy = proxy, .collider = collision::Collider(proxy), .refinement = next++}));
  };
}

}  // namespace

struct Session::Impl {
  Impl(const engine::Context& context, SessionOptions o)
      : options(std::move(o)),
        nothing_runs_behind(context.executor->concurrency() == 1 &&
                            options.pipeline.mode == engine::PipelineMode::kLatency),
        pipeline(context, options.pipeline),
        bodies(pipeline) {}

  SessionOptions options;
  bool nothing_runs_behind;
  engine::FramePipeline pipeline;
  LiveStream bodies;  // after the pipeline, because streams must be destroyed first
  std::optional<cloth::Solver> solver;
  Wardrobe wardrobe;
  const LiveBody* fitted_to = nullptr;  // the body with the surface that the pins lie on

  /// Sets the pins for a new proxy. It may allocate, because it does not run in every frame.
  void hold_garments_on(const LiveBody& body) {
    solver->move_pins(held_positions(wardrobe, body.collider, options.solver.thickness_m));
    fitted_to = &body;
  }
};

Session::Session(const engine::Context& context, SessionOptions options)
    : impl_(std::make_unique<Impl>(context, std::move(options))) {}

Session::~Session() = default;

engine::Ticket Session::submit(BodySource source) {
  PreparationOptions options{.segment = impl_->options.segment, .fit = impl_->options.fit};
  if (impl_->options.region_margin_m && impl_->solver) {
    options.garments = {impl_->wardrobe.mesh};
    options.region_margin_m = *impl_->options.region_margin_m;
  }
  return impl_->bodies.submit("prepare body",
                              [source = std::move(source), options = std::move(options)](
                                  const engine::Context& context, LiveSink& sink) -> engine::Result<void> {
                                auto preparation = Preparation::make(options, publish_to(sink));
                                if (!preparation) return std::move(preparation).error();
                                return preparation->run(context, source);
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
  impl_->wardrobe = std::move(all).value();
  impl_->fitted_to = nullptr;
  return {};
}

FrameOutcome Session::frame(double dt_s) {
  if (impl_->nothing_runs_behind) impl_->pipeline.run_pending();
  FrameOutcome outcome;
  outcome.timing = impl_->pipeline.frame([&](const engine::Context& context) {
    const LiveBody* body = impl_->bodies.current();
    outcome.has_body = body != nullptr;
    if (body) outcome.proxy_hash = body->proxy.hash();
    if (body && body != impl_->fitted_to && impl_->solver) impl_->hold_garments_on(*body);
    // Without a body the garments would fall to the floor before the first one is ready.
    if (body && impl_->solver) outcome.cloth = impl_->solver->step(context, body->collider, dt_s);
  });
  return outcome;
}

const LiveBody* Session::body() const noexcept {
  return impl_->bodies.current();
}

std::size_t Session::vertices() const noexcept {
  return impl_->wardrobe.mesh.positions.size();
}

void Session::positions(std::span<geometry::Vec3> out) const {
  if (impl_->solver) impl_->solver->positions(out);
}

std::uint64_t Session::hash() const noexcept {
  return impl_->solver ? impl_->solver->hash() : 0;
}

engine::FramePipeline& Session::pipeline() noexcept {
  return impl_->pipeline;
}

}  // namespace bodice::tryon
