#include <bodice/fitting/fit.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include <bodice/engine/catch_canceled.hpp>
#include <bodice/engine/clock.hpp>
#include <bodice/engine/message.hpp>
#include <bodice/engine/stage_timer.hpp>

#include "base/check_input.hpp"
#include "base/skin_hash.hpp"
#include "fit/measure.hpp"
#include "fit/part_fit.hpp"
#include "fit/uniform_offset.hpp"
#include "plan/plan.hpp"
#include "tiers/relief.hpp"
#include "tiers/tiers.hpp"

namespace bodice::inline v0_1::fitting {
namespace {

constexpr double kKeptTo = 1.1;     // times the target: the gap that the target search aims at
constexpr double kWarnAbove = 1.2;  // times the target: a larger gap is a warning

engine::Result<Draft> run_tier(const engine::Context& context, const LabeledSkin& skin,
                               const FitOptions& options, int count, std::vector<engine::StageTime>& stages) {
  using proxy::Tier;
  if (options.tier == Tier::kTight) {
    engine::StageTimer tight(context, stages, "tight");
    const SkinSource source = make_skin_source(context, skin, options.parts);
    return fit_tight(context, source, options, count, options.time_budget_s.value_or(kNoTimeLimit_s));
  }
  engine::StageTimer timer(context, stages, "fit");
  if (options.tier == Tier::kSolid) return fit_solid(context, skin, options, count);
  return fit_paper(context, skin, options, count);
}

/// Runs plans one after the other. Relief keeps its ellipsoids while only the size of its tables changes.
class PlanRunner {
 public:
  PlanRunner(const engine::Context& context, const LabeledSkin& skin, const FitOptions& options,
             std::vector<engine::StageTime>& stages)
      : context_(context), skin_(skin), options_(options), stages_(stages) {}

  engine::Result<Draft> run(const Plan& plan, std::optional<double> time_left_s) {
    options_.tier = plan.tier;
    options_.time_budget_s = time_left_s;
    auto draft = plan.tier == proxy::Tier::kRelief ? engine::Result<Draft>(run_relief(plan))
                                                   : run_tier(context_, skin_, options_, plan.count, stages_);
    options_.on_improved = nullptr;  // another plan starts over: its first proxies are worse than this result
    return draft;
  }

 private:
  const Draft& run_relief(const Plan& plan) {
    if (relief_ && relief_->count() == plan.count)
      relief_->resize(plan.relief_bytes);
    else
      relief_ = std::make_unique<ReliefRun>(context_, skin_, options_, plan, stages_);
    return relief_->draft();
  }

  const engine::Context& context_;
  const LabeledSkin& skin_;
  FitOptions options_;
  std::vector<engine::StageTime>& stages_;
  std::unique_ptr<ReliefRun> relief_;
};

/// Warns of parts with a cluster error above the threshold mu.
void warn_of_thresholds(FitResult& result) {
  std::string worse;
  for (const PartFit& part : result.parts) {
    const double mu_m = body::is_torso(part.part) ? result.mu_torso_m : result.mu_limbs_m;
    if (!part.cluster_error || part.cluster_error->max_m <= mu_m) continue;
    worse += engine::message(worse.empty() ? "" : ", ", body::name(part.part), " by ",
                             1e3 * (part.cluster_error->max_m - mu_m), " mm");
  }
  if (worse.empty()) return;
  result.warnings.push_back({"thresholds-not-reached", "",
                             "The cluster errors of some parts exceed their threshold mu: " + worse + ".",
                             "Allow more ellipsoids, or raise the thresholds."});
}

/// Warns of a proxy of relief that stands far off the skin somewhere, which no tier of its error does.
void warn_of_lumps(FitResult& result) {
  // A share of the stature, 25 mm: no body of the data folder comes near it.
  constexpr double kLump = 0.015;
  if (result.proxy.tier() != proxy::Tier::kRelief) return;
  if (!(result.accuracy.gap_m.max > kLump * result.proxy.stature_m())) return;
  const auto worst =
      std::ranges::max_element(result.parts, {}, [](const PartFit& part) { return part.gap_m.max; });
  result.warnings.push_back(
      {"far-from-skin", "",
       engine::message("The proxy is up to ", std::lround(1e3 * result.accuracy.gap_m.max),
                       " mm off the skin, at ", body::name(worst->part), "."),
       "Look at a picture (program: --picture). Tier tight has no lumps; a closed skin without folds in one "
       "another has none, either."});
}

void add_warnings(const FitOptions& options, FitResult& result) {
  warn_of_thresholds(result);
  if (options.measure_accuracy) warn_of_lumps(result);
  const auto count = static_cast<int>(result.proxy.ellipsoids().size());
  const double frame_us = predicted_frame_us(result.proxy.tier(), count);
  if (options.budget_us && frame_us > kBudgetKeptTo * *options.budget_us)
    result.warnings.push_back({"budget-not-reached", "",
                               engine::message("A query of 10,000 particles takes about ", frame_us,
                                               " us where ", *options.budget_us, " us were requested."),
                               "Allow more time, or choose tier tight with few ellipsoids."});
  if (options.target_error_m && result.accuracy.gap_m.mean > kWarnAbove * *options.target_error_m)
    result.warnings.push_back(
        {"target-error-not-reached", "",
         engine::message("The mean gap is ", 1e3 * result.accuracy.gap_m.mean, " mm where ",
                         1e3 * *options.target_error_m, " mm were requested."),
         "Choose a finer tier, allow more ellipsoids or more time."});
}

/// The result of one try of the target search.
struct Found {
  Draft draft;
  Measured measured;
  proxy::Tier planned;
  bool out_of_time = false;
};

/// An anytime tier that runs out of time ends with what it has; the warning keeps that apart from its best.
void warn_of_time(const FitOptions& options, proxy::Tier planned, FitResult& result) {
  std::string message =
      engine::message("The fit was ended by its time budget of ", *options.time_budget_s, " s");
  if (const proxy::Tier made = result.proxy.tier(); made != planned)
    message += engine::message(", with tier ", proxy::name(made), " in place of ", proxy::name(planned));
  result.warnings.push_back(
      {"time-budget-spent", "", message + ".", "Allow more time, or ask for fewer ellipsoids."});
}

/// Whether `a` is better than `b`: a result within the target beats one beyond it, then the closer one wins.
bool better(const Measured& a, const Measured& b, double target_m) {
  const double of_a = a.accuracy.gap_m.mean / target_m, of_b = b.accuracy.gap_m.mean / target_m;
  if ((of_a > kKeptTo) != (of_b > kKeptTo)) return of_a <= kKeptTo;
  return std::abs(std::log(of_a)) < std::abs(std::log(of_b));
}

/// Runs the one plan without a target, else the best of those that the target search tries. Fails if no
/// ellipsoid results.
engine::Result<Found> search(const engine::Context& context, const LabeledSkin& skin,
                             const FitOptions& options, std::vector<engine::StageTime>& stages) {
  TargetSearch tries(options, skin.stature_m);
  PlanRunner runner(context, skin, options, stages);
  const std::int64_t begin_ns = context.clock->now_ns();
  std::optional<double> left_s = options.time_budget_s;
  std::optional<Found> best;
  for (bool more = true; more;) {
    const proxy::Tier planned = tries.plan().tier;
    auto draft = runner.run(tries.plan(), left_s);
    if (!draft) return draft.error();
    if (draft->data.ellipsoids.empty()) return no_skin();
    draft->data.stature_m = skin.stature_m;
    draft->data.frame = skin.frame;
    Measured now;
    if (options.measure_accuracy || options.target_error_m) {
      engine::StageTimer timer(context, stages, "measure");
      now = measure(context, draft->data, skin, *skin.distance, draft->parts);
    }
    if (left_s)
      left_s = std::max(
          0.0, *options.time_budget_s - 1e-9 * static_cast<double>(context.clock->now_ns() - begin_ns));
    more = options.target_error_m && left_s.value_or(1.0) > 0.0 && tries.correct(now.accuracy.gap_m.mean);
    if (!best || better(now, best->measured, options.target_error_m.value_or(0.0)))
      best = {std::move(*draft), std::move(now), planned};
  }
  best->out_of_time = left_s && *left_s <= 0.0;
  return std::move(*best);
}

/// Whether the fit needs signed distances to the skin: the tier paper works on vertices alone, unless it is
/// measured.
bool needs_distances(const LabeledSkin& skin, const FitOptions& options) {
  return options.measure_accuracy || options.target_error_m ||
         TargetSearch(options, skin.stature_m).plan().tier != proxy::Tier::kPaper;
}

engine::Result<FitResult> fit_checked(const engine::Context& context, const LabeledSkin& skin,
                                      const FitOptions& options) {
  std::vector<engine::StageTime> stages;
  std::unique_ptr<geometry::MeshDistance> own;
  LabeledSkin judged = skin;
  if (!skin.distance && needs_distances(skin, options)) {
    engine::StageTimer timer(context, stages, "distance");
    own = std::make_unique<geometry::MeshDistance>(context, skin.mesh);
    judged.distance = own.get();
  }
  auto found = search(context, judged, options, stages);
  if (!found) return found.error();
  auto& [draft, measured, planned, out_of_time] = *found;
  if (options.target_error_m && draft.data.tier == proxy::Tier::kTight)
    grow_to_target(context, judged, draft.parts, *options.target_error_m, draft.data, measured);
  draft.data.source_hash = skin_hash(skin.mesh);
  const FittedEllipsoids fitted{draft.data.ellipsoids, std::move(draft.cluster_error_m)};
  auto made = proxy::BodyProxy::make(std::move(draft.data));
  if (!made) return made.error();
  FitResult result{.proxy = std::move(*made)};
  result.mu_torso_m = draft.mu.torso_m;
  result.mu_limbs_m = draft.mu.limbs_m;
  result.accuracy = measured.accuracy;
  result.parts = part_fits(context, skin, fitted, measured, draft.parts);
  result.stages = std::move(stages);
  if (out_of_time) warn_of_time(options, planned, result);
  add_warnings(options, result);
  return result;
}

}  // namespace

engine::Result<FitResult> fit(const engine::Context& context, const LabeledSkin& skin,
                              const FitOptions& options) {
  if (auto ok = check_input(skin, options); !ok) return ok.error();
  return engine::catch_canceled("The fit", [&] { return fit_checked(context, skin, options); });
}

}  // namespace bodice::fitting
