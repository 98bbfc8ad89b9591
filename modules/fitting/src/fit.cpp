#include <bodice/fitting/fit.hpp>

#include <algorithm>
#include <cmath>
#include <memory>

#include <bodice/engine/hash.hpp>
#include <bodice/engine/stage_timer.hpp>

#include "check_input.hpp"
#include "measure.hpp"
#include "part_fit.hpp"
#include "plan.hpp"
#include "tiers.hpp"

namespace bodice::fitting {
namespace {

constexpr double kNoTimeLimit_s = 1e6;

std::uint64_t hash_of(const geometry::TriMesh& mesh) {
  engine::Hasher hasher;
  for (const Vec3& p : mesh.positions)
    for (int j = 0; j < 3; ++j) hasher.add(p[j]);
  for (const geometry::Triangle& t : mesh.triangles)
    for (const geometry::Index v : t) hasher.add(v);
  return hasher.value();
}

int starting_count(const LabelledSkin& skin, const FitOptions& options) {
  const int most = options.max_ellipsoids.value_or(10 * kMostEllipsoids);
  if (options.budget_us) return std::min(most, count_within_budget(options.tier, *options.budget_us));
  if (options.target_error_m)
    return std::min(most, count_for_error(options.tier, *options.target_error_m, skin.stature_m));
  if (options.mu_torso_m && options.mu_limbs_m) return most;
  return options.max_ellipsoids.value_or(kDefaultEllipsoids);
}

Draft run_tier(const engine::Context& context, const LabelledSkin& skin, const FitOptions& options, int count,
               std::vector<engine::StageTime>& stages) {
  using proxy::Tier;
  if (options.tier == Tier::kTight || options.tier == Tier::kRelief) {
    const bool relief = options.tier == Tier::kRelief;
    const double budget_s = options.time_budget_s.value_or(kNoTimeLimit_s);
    const std::int64_t deadline =
        context.clock->now_ns() + static_cast<std::int64_t>(1e9 * std::min(budget_s, kNoTimeLimit_s));
    engine::StageTimer tight(context, stages, "tight");
    const SkinSource source = make_skin_source(context, skin, options.parts);
    Draft draft = fit_tight(context, source, options, count, (relief ? 0.5 : 1.0) * budget_s);
    tight.stop();
    if (!relief) return draft;
    engine::StageTimer timer(context, stages, "relief");
    add_relief(context, source, options, deadline, draft);
    return draft;
  }
  engine::StageTimer timer(context, stages, "fit");
  if (options.tier == Tier::kSolid)
    return fit_solid(context, make_skin_source(context, skin, options.parts), options, count);
  return fit_paper(context, skin, options, count);
}

/// The count to try next for a target that was missed: gaps fall about with the square root of the count.
int next_count(int count, double gap_m, double target_m, int most) {
  const double ratio = gap_m / target_m;
  return std::clamp(static_cast<int>(std::ceil(count * ratio * ratio)), count + 1, std::max(count + 1, most));
}

void add_warnings(const FitOptions& options, const Draft& draft, FitResult& result) {
  if (!draft.thresholds_reached)
    result.warnings.push_back({"thresholds-not-reached", "",
                               "Some ellipsoids are worse than their threshold mu.",
                               "Allow more ellipsoids, or raise the thresholds."});
  if (options.target_error_m && result.accuracy.gap_m.mean > *options.target_error_m)
    result.warnings.push_back({"target-error-not-reached", "",
                               "The mean gap is " + std::to_string(1e3 * result.accuracy.gap_m.mean) +
                                   " mm where " + std::to_string(1e3 * *options.target_error_m) +
                                   " mm were asked for.",
                               "Choose a finer tier, allow more ellipsoids or more time."});
}

engine::Result<FitResult> fit_checked(const engine::Context& context, const LabelledSkin& skin,
                                      const FitOptions& options) {
  std::vector<engine::StageTime> stages;
  std::unique_ptr<geometry::MeshDistance> own;
  LabelledSkin judged = skin;
  if (!skin.distance) {
    engine::StageTimer timer(context, stages, "distance");
    own = std::make_unique<geometry::MeshDistance>(context, skin.mesh);
    judged.distance = own.get();
  }
  const int most = options.max_ellipsoids.value_or(kMostEllipsoids);
  int count = starting_count(skin, options);
  Draft draft;
  Measured measured;
  constexpr int kTargetTries = 4;
  for (int attempt = 0; attempt < kTargetTries; ++attempt) {
    draft = run_tier(context, judged, options, count, stages);
    draft.data.stature_m = skin.stature_m;
    draft.data.frame = skin.frame;
    draft.data.source_hash = hash_of(skin.mesh);
    if (draft.data.ellipsoids.empty())
      return engine::Error{engine::ErrorCode::kUnusableGeometry, "The selected parts have no skin.",
                           "Select parts that occur among the labels."};
    engine::StageTimer timer(context, stages, "measure");
    measured = measure(context, draft.data, judged, *judged.distance, options.parts);
    const double gap = measured.accuracy.gap_m.mean;
    if (!options.target_error_m || gap <= *options.target_error_m || count >= most || options.budget_us)
      break;
    count = next_count(count, gap, *options.target_error_m, most);
  }
  const std::vector<proxy::ProxyEllipsoid> ellipsoids = draft.data.ellipsoids;
  auto made = proxy::BodyProxy::make(std::move(draft.data));
  if (!made) return made.error();
  FitResult result{.proxy = std::move(*made)};
  result.mu_torso_m = draft.mu.torso_m;
  result.mu_limbs_m = draft.mu.limbs_m;
  result.accuracy = measured.accuracy;
  result.parts = part_fits(skin, ellipsoids, measured, options.parts);
  result.stages = std::move(stages);
  add_warnings(options, draft, result);
  return result;
}

}  // namespace

engine::Result<FitResult> fit(const engine::Context& context, const LabelledSkin& skin,
                              const FitOptions& options) {
  if (auto ok = check_input(skin, options); !ok) return ok.error();
  try {
    return fit_checked(context, skin, options);
  } catch (const engine::Cancelled&) {
    return engine::Error{engine::ErrorCode::kCancelled, "The fit was cancelled.", ""};
  }
}

}  // namespace bodice::fitting
