#include <bodice/tryon/preparation.hpp>

#include <optional>
#include <utility>

#include <bodice/binding/bind.hpp>
#include <bodice/binding/flexed_skin.hpp>
#include <bodice/fitting/enclose_parts.hpp>
#include <bodice/tryon/reach.hpp>
#include <bodice/tryon/rigged_body.hpp>

#include "body/load_body.hpp"
#include "body/segment_tasks.hpp"

namespace bodice::inline v0_1::tryon {
namespace {

using Skin = std::shared_ptr<SegmentedSkin>;
using engine::Context;
using engine::Result;
using proxy::BodyProxy;

/// The parts to fit, as a bit set for FitOptions::parts.
Result<std::uint32_t> choose_region(const Context& context, const PreparationOptions& options,
                                    const SegmentedSkin& skin) {
  if (options.garments.empty()) return options.fit.parts;
  const auto reached = reachable_parts(context, skin, options.garments, options.region_margin_m);
  if (!reached) return reached.error();
  if (const std::uint32_t parts = options.fit.parts & *reached) return parts;
  return with_body_name(
      {engine::ErrorCode::kUnusableGeometry, "No part of the body is within reach of the garments.",
       "Check that they are in the body's coordinates and units, or raise the margin."},
      skin.input);
}

binding::SkinnedBody skinned(const SegmentedSkin& skin) {
  return {skin.input.skin, skin.rig->skeleton, skin.rig->weights, skin.anatomy.part};
}

/// Publishes the proxies of a body. A proxy is published once only, although it may be both the last
/// refinement of a tier and its result.
class Publisher {
 public:
  Publisher(OnProxy on_proxy, bool bind) : on_proxy_(std::move(on_proxy)), bind_(bind) {}

  void begin(Skin skin) { skin_ = std::move(skin), last_.reset(); }
  bool binds() const { return bind_; }

  /// Publishes a proxy, bound to the rig if the options request it, and returns the published proxy.
  Result<BodyProxy> publish(const Context& context, const BodyProxy& proxy) {
    if (last_ && last_->hash() == proxy.hash()) return *published_;
    auto bound = bind_ ? binding::bind(context, proxy, skinned(*skin_)) : Result<BodyProxy>(proxy);
    if (!bound) return bound;
    last_ = proxy;
    published_ = *bound;
    if (on_proxy_) on_proxy_(skin_, *bound);
    return bound;
  }

  /// Publishes the last proxy with the ellipsoids of these parts replaced.
  Result<void> publish_part(const Context& context, proxy::Tier tier, const fitting::FittedPart& part) {
    BodyProxy::Data data{.tier = tier,
                         .stature_m = last_->stature_m(),
                         .source_hash = last_->source_hash(),
                         .frame = last_->frame()};
    for (const proxy::ProxyEllipsoid& e : last_->ellipsoids())
      if (!(part.parts & 1u << static_cast<unsigned>(e.part))) data.ellipsoids.push_back(e);
    data.ellipsoids.insert(data.ellipsoids.end(), part.ellipsoids.begin(), part.ellipsoids.end());
    auto proxy = BodyProxy::make(std::move(data));
    if (!proxy) return std::move(proxy).error();
    if (auto published = publish(context, *proxy); !published) return std::move(published).error();
    return {};
  }

 private:
  OnProxy on_proxy_;
  bool bind_;
  Skin skin_;
  std::optional<BodyProxy> last_, published_;  // as fitted, and as published
};

Result<fitting::FitResult> fit_parts(const Context& context, const SegmentedSkin& skin,
                                     fitting::FitOptions options, std::uint32_t parts, Publisher& publisher) {
  options.parts = parts;
  options.on_improved = [&](const BodyProxy& better) {
    // A plain proxy is replaced sooner than it could be bound.
    if (!publisher.binds() || !better.relief().empty()) static_cast<void>(publisher.publish(context, better));
  };
  std::vector<geometry::Vec3> flexed;
  if (publisher.binds()) flexed = binding::flexed_skin(context, skinned(skin), skin.anatomy.part);
  options.flexed = flexed;
  const proxy::Tier tier = options.tier.value_or(proxy::Tier::kSolid);  // only plain tiers give parts
  // A part that gives no valid proxy is skipped; where the cause persists, the fit fails as well.
  options.on_part = [&](const fitting::FittedPart& part) {
    if (!publisher.binds()) static_cast<void>(publisher.publish_part(context, tier, part));
  };
  auto fit = fitting::fit(context, labeled(skin), options);
  if (!fit) return with_body_name(std::move(fit).error(), skin.input);
  auto published = publisher.publish(context, fit->proxy);
  if (!published) return with_body_name(std::move(published).error(), skin.input);
  fit->proxy = std::move(published).value();
  return fit;
}

/// Publishes one ellipsoid a part: the first proxy.
Result<void> publish_coarse(const Context& context, const Skin& skin, std::uint32_t parts,
                            Publisher& publisher) {
  auto enclosed = fitting::enclose_parts(context, labeled(*skin), parts);
  if (!enclosed) return with_body_name(std::move(enclosed).error(), skin->input);
  publisher.begin(skin);
  if (auto published = publisher.publish(context, *enclosed); !published)
    return with_body_name(std::move(published).error(), skin->input);
  return {};
}

/// Publishes solid ellipsoids, part by part: they take a tenth of a second and have no leaks.
Result<void> publish_solid_parts(const Context& context, const PreparationOptions& options,
                                 const SegmentedSkin& skin, std::uint32_t parts, Publisher& publisher) {
  if (options.fit.tier.value_or(proxy::Tier::kRelief) <= proxy::Tier::kSolid) return {};
  // The limits of the final fit hold for solid ellipsoids as well, because earlier frames have no more time
  // than later ones.
  auto fit = fit_parts(context, skin,
                       {.tier = proxy::Tier::kSolid,
                        .max_ellipsoids = options.fit.max_ellipsoids,
                        .budget_us = options.fit.budget_us,
                        .measure_accuracy = false},
                       parts, publisher);
  if (!fit) return std::move(fit).error();
  return {};
}

using Options = std::shared_ptr<const PreparationOptions>;

/// Adds the tasks from a source to a segmented skin, which gets a rig if proxies are to be bound.
Result<engine::Output<Skin>> add_skin_tasks(engine::GraphBuilder& builder,
                                            const engine::Output<BodySource>& source, const Options& set) {
  if (!set->bind) {
    auto body = builder.add(
        "body",
        [set](const Context& context, const BodySource& from) {
          return load_body(context, from, set->segment.import);
        },
        source);
    return add_segment_tasks(builder, body, set->segment);
  }
  auto loaded = builder.add(
      "rigged body",
      [set](const Context& context, const BodySource& from) {
        return load_rigged_body(context, from, set->segment.import);
      },
      source);
  auto body = builder.add(
      "body", [](const Context&, const LoadedBody& both) { return both.body; }, loaded);
  auto skin = add_segment_tasks(builder, body, set->segment);
  if (!skin) return std::move(skin).error();
  return builder.add(
      "rig",
      [](const Context& context, const BodySource& from, const LoadedBody& both,
         const Skin& on) -> Result<Skin> {
        on->rig = both.rig;
        if (auto given = give_rig(context, from, *on); !given) return std::move(given).error();
        return on;
      },
      source, loaded, *skin);
}

}  // namespace

Result<Preparation> Preparation::make(PreparationOptions options, OnProxy on_proxy) {
  const auto set = std::make_shared<const PreparationOptions>(std::move(options));
  const auto publisher = std::make_shared<Publisher>(std::move(on_proxy), set->bind);

  engine::GraphBuilder builder;
  auto source = builder.input<BodySource>("source");
  auto skin = add_skin_tasks(builder, source, set);
  if (!skin) return std::move(skin).error();
  auto region = builder.add(
      "region", [set](const Context& c, const Skin& on) { return choose_region(c, *set, *on); }, *skin);
  auto coarse = builder.add(
      "coarse proxy",
      [publisher](const Context& c, const Skin& on, const std::uint32_t& parts) {
        return publish_coarse(c, on, parts, *publisher);
      },
      *skin, region);
  auto solid = builder.add(
      "solid parts",
      [set, publisher](const Context& c, const Skin& on, const std::uint32_t& parts) {
        return publish_solid_parts(c, *set, *on, parts, *publisher);
      },
      *skin, region);
  auto proxy = builder.add(
      "proxy",
      [set, publisher](const Context& c, const Skin& on, const std::uint32_t& parts) {
        return fit_parts(c, *on, set->fit, parts, *publisher);
      },
      *skin, region);
  builder.order(coarse, solid);
  builder.order(solid, proxy);
  auto graph = std::move(builder).build();
  if (!graph) return std::move(graph).error();
  return Preparation(std::move(graph).value(), source, proxy);
}

Result<void> Preparation::run(const Context& context, BodySource body) {
  graph_.set(source_, std::move(body));
  return graph_.run(context);
}

}  // namespace bodice::tryon
