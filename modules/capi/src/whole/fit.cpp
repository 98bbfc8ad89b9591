#include "whole/fit.hpp"

#include <algorithm>
#include <cmath>

#include <bodice/binding/bind.hpp>

#include "base/handles.hpp"
#include "base/structures.hpp"
#include "frame/proxy.hpp"
#include "whole/skin.hpp"

using namespace bodice;
using capi::invalid;
using capi::Outcome;

namespace bodice::inline v0_1::capi {
namespace {

bodice_fit_report as_c(const fitting::FitResult& fit, double seconds) {
  auto report = with_defaults<bodice_fit_report>();
  report.gap_mean_m = fit.accuracy.gap_m.mean;
  report.gap_p95_m = fit.accuracy.gap_m.p95;
  report.gap_max_m = fit.accuracy.gap_m.max;
  report.interior_covered = fit.accuracy.interior_covered_percent / 100.0;
  report.skin_outside = fit.accuracy.skin_outside_percent / 100.0;
  report.skin_outside_depth_m = fit.accuracy.skin_outside_depth_m;
  report.seconds = seconds;
  report.ellipsoids = static_cast<std::uint32_t>(fit.proxy.ellipsoids().size());
  report.warnings = static_cast<std::uint32_t>(fit.warnings.size());
  return report;
}

Outcome read_wish(double value, const char* name, std::optional<double>& out) {
  if (!std::isfinite(value) || value < 0.0)
    return invalid(std::string("bodice_fit_options.") + name + " is " + std::to_string(value) + ".",
                   "Give a positive number, or 0 for none.");
  if (value > 0.0) out = value;
  return {};
}

/// Refuses a proxy that was fitted to something else.
Outcome check_fits(const proxy::BodyProxy& proxy, const tryon::SegmentedSkin& skin) {
  const auto ellipsoids = proxy.ellipsoids();
  const auto outside = std::count_if(ellipsoids.begin(), ellipsoids.end(), [&](const auto& ellipsoid) {
    return skin.distance->signed_distance(ellipsoid.shape.center) > 0.0;
  });
  if (10 * static_cast<std::size_t>(outside) > ellipsoids.size())
    return invalid("The proxy is not of this skin: the centers of " + std::to_string(outside) + " of its " +
                       std::to_string(ellipsoids.size()) + " ellipsoids are outside.",
                   "Bind it to the skin that it was fitted to, in the same pose and coordinates.");
  return {};
}

}  // namespace

Outcome read_tier(std::int32_t tier, const char* name, std::optional<proxy::Tier>& out) {
  if (tier < -1 || tier > BODICE_RELIEF)
    return invalid(std::string(name) + " is " + std::to_string(tier) + ".",
                   "Give BODICE_PAPER to BODICE_RELIEF, or -1.");
  if (tier >= 0) out = static_cast<proxy::Tier>(tier);
  return {};
}

Outcome read_fit(const bodice_fit_options& given, fitting::FitOptions& out) {
  BODICE_CHECK(read_tier(given.tier, "bodice_fit_options.tier", out.tier));
  BODICE_CHECK(read_wish(given.target_error_m, "target_error_m", out.target_error_m));
  BODICE_CHECK(read_wish(given.budget_us, "budget_us", out.budget_us));
  BODICE_CHECK(read_wish(given.time_budget_s, "time_budget_s", out.time_budget_s));
  if (given.max_ellipsoids < 0)
    return invalid("bodice_fit_options.max_ellipsoids is " + std::to_string(given.max_ellipsoids) + ".",
                   "Give a positive number, or 0 for none.");
  if (given.max_ellipsoids > 0) out.max_ellipsoids = given.max_ellipsoids;
  out.covering = given.covering != 0;
  return {};
}

Outcome make_fit(Progress& progress, const tryon::SegmentedSkin& skin, const fitting::FitOptions& given,
                 bool bind, Fitted& out) {
  const engine::Context& context = progress.context();
  const std::int64_t begin = context.clock->now_ns();
  progress.stage("fit");
  tryon::SegmentedSkin copy = skin;
  if (!bind) copy.rig = nullptr;
  auto body = tryon::fit_bound_proxy(context, std::move(copy), given);
  if (!body) return body.error();
  for (const engine::Warning& warning : body->fit.warnings) context.warn(warning.sentence());
  out.report = as_c(body->fit, 1e-9 * static_cast<double>(context.clock->now_ns() - begin));
  out.proxy = std::move(body->fit.proxy);
  return {};
}

}  // namespace bodice::capi

bodice_status bodice_fit(const bodice_context* context, const bodice_skin* skin,
                         const bodice_fit_options* given, bodice_proxy** out, bodice_fit_report* report) {
  return capi::guarded([&]() -> Outcome {
    BODICE_CHECK(capi::begin_result(out, "the proxy"));
    BODICE_CHECK(capi::check_handle(context, "The context"));
    BODICE_CHECK(capi::check_handle(skin, "The skin"));
    bodice_fit_options options;
    BODICE_CHECK(capi::read(given, options, true));
    fitting::FitOptions wanted;
    BODICE_CHECK(capi::read_fit(options, wanted));
    BODICE_CHECK(capi::write(capi::with_defaults<bodice_fit_report>(), report, true));
    capi::Progress progress(context->state->engine_context(), options.progress, options.host);
    capi::Fitted fitted;
    BODICE_CHECK(capi::make_fit(progress, skin->skin, wanted, options.bind != 0, fitted));
    *out = new bodice_proxy{context->state, std::move(*fitted.proxy)};
    return capi::write(fitted.report, report, true);
  });
}

bodice_status bodice_proxy_bind(const bodice_context* context, const bodice_proxy* proxy,
                                const bodice_skin* handle, bodice_proxy** out) {
  return capi::guarded([&]() -> Outcome {
    BODICE_CHECK(capi::begin_result(out, "the bound proxy"));
    BODICE_CHECK(capi::check_handle(context, "The context"));
    BODICE_CHECK(capi::check_handle(proxy, "The proxy"));
    BODICE_CHECK(capi::check_handle(handle, "The skin"));
    const tryon::SegmentedSkin& skin = handle->skin;
    if (!skin.rig)
      return invalid("The skin has no rig to bind the proxy to.",
                     "Pass bodice_skin_options.rig, or set find_rig, when the skin is made.");
    BODICE_CHECK(capi::check_fits(proxy->proxy, skin));
    auto bound = binding::bind(context->state->engine_context(), proxy->proxy,
                               {skin.input.skin, skin.rig->skeleton, skin.rig->weights, skin.anatomy.part});
    if (!bound) return bound.error();
    *out = new bodice_proxy{context->state, std::move(bound).value()};
    return {};
  });
}
