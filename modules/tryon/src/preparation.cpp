#include <bodice/tryon/preparation.hpp>

#include <optional>
#include <utility>

#include "load_body.hpp"
#include "segment_tasks.hpp"

namespace bodice::tryon {
namespace {

using Skin = std::shared_ptr<SegmentedSkin>;
using engine::Context;
using engine::Result;
using proxy::BodyProxy;

/// The parts to fit, as FitOptions::parts takes them.
Result<std::uint32_t> choose_region(const Context& context, const PreparationOptions& options,
                                    const SegmentedSkin& skin) {
  if (options.garments.empty()) return options.fit.parts;
  const std::uint32_t parts =
      options.fit.parts & reachable_parts(context, skin, options.garments, options.region_margin_m);
  if (parts != 0) return parts;
  return engine::Error{engine::ErrorCode::kUnusableGeometry,
                       skin.input.file.string() + ": no part of the body is within reach of the garments.",
                       "Check that they are in the same place and units, or raise the margin."};
}

Result<fitting::FitResult> fit_parts(const Context& context, const SegmentedSkin& skin,
                                     fitting::FitOptions options, std::uint32_t parts) {
  options.parts = parts;
  auto fit = fitting::fit(context, labelled(skin), options);
  if (fit) return fit;
  engine::Error error = std::move(fit).error();
  error.message = skin.input.file.string() + ": " + error.message;
  return error;
}

/// Hands each proxy on once, though the last iterate of a tier is its result as well.
class Handover {
 public:
  explicit Handover(OnProxy on_proxy) : on_proxy_(std::move(on_proxy)) {}

  void begin() { last_.reset(); }
  void give(const Skin& skin, const BodyProxy& proxy) {
    if (last_ == proxy.hash()) return;
    last_ = proxy.hash();
    if (on_proxy_) on_proxy_(skin, proxy);
  }

 private:
  OnProxy on_proxy_;
  std::optional<std::uint64_t> last_;
};

}  // namespace

Result<Preparation> Preparation::make(PreparationOptions options, OnProxy on_proxy) {
  const auto set = std::make_shared<const PreparationOptions>(std::move(options));
  const auto handover = std::make_shared<Handover>(std::move(on_proxy));

  engine::GraphBuilder builder;
  auto source = builder.input<BodySource>("source");
  auto body = builder.add(
      "body",
      [set, handover](const Context& context, const BodySource& from) {
        handover->begin();
        return load_body(context, from, set->segment.import);
      },
      source);
  auto skin = add_segment_tasks(builder, body, set->segment);
  if (!skin) return std::move(skin).error();
  auto region = builder.add(
      "region", [set](const Context& c, const Skin& on) { return choose_region(c, *set, *on); }, *skin);
  // Solid ellipsoids first: they are there in milliseconds, and do not leak.
  auto coarse = builder.add(
      "coarse proxy",
      [set, handover](const Context& c, const Skin& on, const std::uint32_t& parts) -> Result<void> {
        if (set->fit.tier.value_or(proxy::Tier::kRelief) <= proxy::Tier::kSolid) return {};
        auto fit = fit_parts(c, *on, {.tier = proxy::Tier::kSolid}, parts);
        if (!fit) return std::move(fit).error();
        handover->give(on, fit->proxy);
        return {};
      },
      *skin, region);
  auto proxy = builder.add(
      "proxy",
      [set, handover](const Context& c, const Skin& on, const std::uint32_t& parts) {
        fitting::FitOptions fit = set->fit;
        fit.on_improved = [&](const BodyProxy& better) { handover->give(on, better); };
        auto last = fit_parts(c, *on, fit, parts);
        if (last) handover->give(on, last->proxy);
        return last;
      },
      *skin, region);
  builder.order(coarse, proxy);
  auto graph = std::move(builder).build();
  if (!graph) return std::move(graph).error();
  return Preparation(std::move(graph).value(), source, proxy);
}

Result<void> Preparation::run(const Context& context, BodySource body) {
  graph_.set(source_, std::move(body));
  return graph_.run(context);
}

}  // namespace bodice::tryon
