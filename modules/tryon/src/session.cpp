#include <bodice/tryon/session.hpp>

#include <optional>
#include <utility>

namespace bodice::tryon {
namespace {

using LiveStream = engine::Stream<LiveBody>;
using LiveSink = engine::Sink<LiveBody>;

engine::Result<SegmentedSkin> segment(const engine::Context& context, const BodySource& source,
                                      const SegmentOptions& options) {
  struct Visitor {
    const engine::Context& context;
    const SegmentOptions& options;
    engine::Result<SegmentedSkin> operator()(const BodyFile& body) const {
      return segment_file(context, body.file, options);
    }
    engine::Result<SegmentedSkin> operator()(const synth::BodyOptions& body) const {
      return segment_builtin(context, body, options);
    }
    engine::Result<SegmentedSkin> operator()(const io::ImportedMesh& body) const {
      return segment_mesh(context, body, options);
    }
  };
  return std::visit(Visitor{context, options}, source);
}

/// Publishes the proxies of one body, each with its collider ready, so that a frame only takes a pointer.
class Publisher {
 public:
  Publisher(std::shared_ptr<const SegmentedSkin> skin, LiveSink& sink)
      : skin_(std::move(skin)), sink_(sink) {}

  void publish(const proxy::BodyProxy& proxy) {
    if (last_hash_ == proxy.hash()) return;
    last_hash_ = proxy.hash();
    sink_.publish(std::make_shared<const LiveBody>(LiveBody{
        .skin = skin_, .proxy = proxy, .collider = collision::Collider(proxy), .refinement = next_++}));
  }

 private:
  std::shared_ptr<const SegmentedSkin> skin_;
  LiveSink& sink_;
  std::optional<std::uint64_t> last_hash_;
  int next_ = 0;
};

fitting::LabelledSkin labelled(const SegmentedSkin& skin) {
  return {.mesh = skin.input.skin,
          .part = skin.anatomy.part,
          .stature_m = skin.anatomy.stature_m,
          .frame = skin.input.frame,
          .distance = skin.distance.get()};
}

/// Coarse first: a solid proxy is there in milliseconds; the asked-for tier follows with each improvement.
engine::Result<void> prepare(const engine::Context& context, const BodySource& source,
                             const SessionOptions& options, LiveSink& sink) {
  auto segmented = segment(context, source, options.segment);
  if (!segmented) return std::move(segmented).error();
  const auto skin = std::make_shared<const SegmentedSkin>(std::move(segmented).value());
  Publisher publisher(skin, sink);

  fitting::FitOptions fit = options.fit;
  if (fit.tier > proxy::Tier::kSolid) {
    fitting::FitOptions coarse;
    coarse.tier = proxy::Tier::kSolid;
    coarse.parts = fit.parts;
    auto first = fitting::fit(context, labelled(*skin), coarse);
    if (!first) return std::move(first).error();
    publisher.publish(first->proxy);
  }
  fit.on_improved = [&](const proxy::BodyProxy& better) { publisher.publish(better); };
  auto last = fitting::fit(context, labelled(*skin), fit);
  if (!last) return std::move(last).error();
  publisher.publish(last->proxy);
  return {};
}

}  // namespace

struct Session::Impl {
  Impl(const engine::Context& context, SessionOptions o)
      : options(std::move(o)), pipeline(context, options.pipeline), bodies(pipeline) {}

  SessionOptions options;
  engine::FramePipeline pipeline;
  LiveStream bodies;  // after the pipeline: streams must go first
  std::optional<cloth::Solver> solver;
  Wardrobe wardrobe;
  const LiveBody* fitted_to = nullptr;  // the body whose surface the pins lie on

  /// Once a proxy, not once a frame: this one may allocate.
  void hold_garments_on(const LiveBody& body) {
    solver->move_pins(held_positions(wardrobe, body.collider, options.solver.thickness_m));
    fitted_to = &body;
  }
};

Session::Session(const engine::Context& context, SessionOptions options)
    : impl_(std::make_unique<Impl>(context, std::move(options))) {}

Session::~Session() = default;

engine::Ticket Session::submit(BodySource source) {
  return impl_->bodies.submit("prepare body", [source = std::move(source), options = impl_->options](
                                                  const engine::Context& context, LiveSink& sink) {
    return prepare(context, source, options, sink);
  });
}

engine::Result<void> Session::dress(const std::vector<WornGarment>& garments) {
  Wardrobe all = join(garments);
  cloth::Fabric fabric = impl_->options.fabric;
  if (fabric.name.empty()) {
    auto cotton = cloth::find_fabric("cotton");
    if (!cotton) return std::move(cotton).error();
    fabric = std::move(cotton).value();
  }
  auto solver = cloth::Solver::make(all.mesh, all.held, fabric, impl_->options.solver);
  if (!solver) return std::move(solver).error();
  impl_->solver.emplace(std::move(solver).value());
  impl_->wardrobe = std::move(all);
  impl_->fitted_to = nullptr;
  return {};
}

FrameOutcome Session::frame(double dt_s) {
  FrameOutcome outcome;
  outcome.timing = impl_->pipeline.frame([&](const engine::Context& context) {
    const LiveBody* body = impl_->bodies.current();
    outcome.has_body = body != nullptr;
    if (body) outcome.proxy_hash = body->proxy.hash();
    if (body && body != impl_->fitted_to && impl_->solver) impl_->hold_garments_on(*body);
    // Without a body the garments would fall to the floor before there is anything to wear them.
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
