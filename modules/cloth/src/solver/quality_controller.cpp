#include "solver/quality_controller.hpp"

#include <algorithm>
#include <cmath>

namespace bodice::inline v0_1::cloth {
namespace {

/// A shorter frame moves nothing within the precision of floats, and the inverse square of its substeps would
/// overflow.
constexpr double kLeastFrame_s = 1e-15;
constexpr int kWorstLevel = 3;      // the level at which everything is dropped
constexpr int kGoodFrames = 60;     // frames at half of the budget, after which quality rises by a level
constexpr int kFewestSubsteps = 2;  // substeps are not halved below this

/// The FrameLimit bits of a level.
std::uint32_t dropped(int level) {
  return (level >= 1 ? kNoSelfContact : 0u) | (level >= 2 ? kBendingHalved : 0u) |
         (level >= 3 ? kSubstepsHalved : 0u);
}

}  // namespace

Plan plan_frame(const SolverOptions& options, double dt_s, const Pace& pace, int level) {
  Plan plan;
  if (!(dt_s >= kLeastFrame_s)) {
    plan.limits = dt_s > 0.0 ? kTimeCut : 0u;
    return plan;
  }
  plan.simulated_s = std::min(dt_s, kMaxSubsteps * kMaxSubstep_s);
  plan.limits = dropped(level) | (plan.simulated_s < dt_s ? kTimeCut : 0u);
  const int requested = level >= 3 ? std::max(kFewestSubsteps, options.substeps / 2) : options.substeps;
  plan.travel_m =
      plan.simulated_s * (pace.speed_m_s + plan.simulated_s * options.environment.gravity_m_s2.norm());
  const int for_stretch = options.doubled_when_stretched && pace.stretched ? 2 * requested : requested;
  const double wanted =
      std::max({static_cast<double>(for_stretch), std::ceil(plan.simulated_s / kMaxSubstep_s - 1e-9),
                std::ceil(plan.travel_m / pace.max_travel_m)});
  plan.substeps = static_cast<int>(std::min(wanted, static_cast<double>(kMaxSubsteps)));
  if (plan.substeps > requested) plan.limits |= kMoreSubsteps;
  plan.substep_s = static_cast<float>(plan.simulated_s / plan.substeps);
  return plan;
}

void adjust_quality(const SolverOptions& options, double frame_us, Budget& budget) {
  if (!(options.budget_us > 0.0)) return;
  budget.good_frames = frame_us < 0.5 * options.budget_us ? budget.good_frames + 1 : 0;
  if (frame_us > options.budget_us) {
    budget.level = std::min(kWorstLevel, budget.level + 1);
  } else if (budget.good_frames >= kGoodFrames) {
    budget.level = std::max(0, budget.level - 1);
    budget.good_frames = 0;
  }
}

}  // namespace bodice::cloth
