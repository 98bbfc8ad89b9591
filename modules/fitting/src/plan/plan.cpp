#include "plan/plan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "relief/relief_fit.hpp"

namespace bodice::inline v0_1::fitting {
namespace {

using proxy::Tier;

constexpr int kMostAttempts = 9;
constexpr double kFewestToStart = 8.0;  // with fewer than the body has limbs the gap formula does not hold
/// Largest count of tier solid. With more, each ellipsoid grows so much to close the holes next to its
/// neighbors that the gap widens again.
constexpr int kMostSolid = 200;
constexpr int kFewestInBudget =
    16;  // fewer take as long, because a query evaluates a register of them at a time
/// For finer targets than this fraction of stature, plain ellipsoids take more time a particle than relief.
constexpr double kFinestPlain = 1.6e-3 / 1.7;
/// Fractions of stature: the finest targets for which relief starts with 32 and with 55 ellipsoids.
constexpr double kFinestOf32 = 0.75e-3 / 1.7, kFinestOf55 = 0.40e-3 / 1.7;

/// gap = at_89 * stature * (89 / count)^power: where the target search starts. `bench/fit --gap-formula`
/// prints the constants anew.
struct GapFormula {
  double at_89, power;
};

GapFormula gap_formula(Tier tier) {
  switch (tier) {
    case Tier::kPaper:
      return {0.0060, 0.5};
    case Tier::kSolid:
      return {0.0060, 0.5};
    case Tier::kTight:
      return {0.00060, 1.0};
    case Tier::kRelief:
      return {0.00013, 0.7};
  }
  return {0.0060, 0.5};
}

/// The gap of relief with a fixed count falls with this power of the bytes.
constexpr double kReliefPower = 0.6;

/// Bytes of `count` ellipsoids with the smallest useful tables.
std::size_t least_bytes(int count) {
  return static_cast<std::size_t>(count) * (15 * sizeof(float) + sizeof(proxy::ReliefTable) + 2 * 8 * 8);
}

int relief_count(double target_m, double stature_m, int most) {
  const double target = target_m / stature_m;
  return std::min(most, target > kFinestOf32 ? 32 : target > kFinestOf55 ? 55 : kDefaultEllipsoids);
}

/// The most accurate plan with a predicted time within the budget.
Plan plan_within(double budget_us, std::optional<Tier> tier, int most, double stature_m) {
  Plan best;
  double least = std::numeric_limits<double>::infinity();
  for (const Tier candidate : {Tier::kTight, Tier::kRelief}) {
    const Tier t = tier.value_or(candidate);
    const int largest = t == Tier::kRelief ? kDefaultEllipsoids : kMostEllipsoids;
    const int wanted = std::max(kFewestInBudget, count_within_budget(t, budget_us));
    const int count = std::min({most, largest, wanted});
    const double gap = predicted_gap_m(t, count, stature_m);
    if (predicted_frame_us(t, count) > kBudgetKeptTo * budget_us && std::isfinite(least)) continue;
    if (gap < least) best = {t, count, kReliefBytes}, least = gap;
  }
  return best;
}

}  // namespace

double predicted_frame_us(Tier tier, int ellipsoids) {
  // Ten times the nanoseconds a particle; `bench/tradeoff --only cost-model` measures the constants anew.
  return tier == Tier::kRelief ? 10.0 * (9.7 + 0.224 * ellipsoids) : 10.0 * (6.2 + 0.12 * ellipsoids);
}

int count_within_budget(Tier tier, double budget_us) {
  int count = 1;
  while (count < kMostEllipsoids && predicted_frame_us(tier, count + 1) <= budget_us) ++count;
  return count;
}

double predicted_gap_m(Tier tier, int ellipsoids, double stature_m) {
  const GapFormula formula = gap_formula(tier);
  return formula.at_89 * stature_m * std::pow(89.0 / std::max(1, ellipsoids), formula.power);
}

TargetSearch::TargetSearch(const FitOptions& options, double stature_m)
    : target_m_(options.target_error_m),
      most_(options.max_ellipsoids.value_or(kMostEllipsoids)),
      tier_is_free_(!options.tier) {
  plan_ = {options.tier.value_or(Tier::kRelief), std::min(most_, kDefaultEllipsoids), kReliefBytes};
  if (options.max_ellipsoids) plan_.count = *options.max_ellipsoids;
  if (options.mu_torso_m) {  // the thresholds stop splitting, not a count
    if (tier_is_free_) plan_.tier = Tier::kPaper;
    plan_.count = most_ = options.max_ellipsoids.value_or(10 * kMostEllipsoids);
  }
  if (options.budget_us) {
    plan_ = plan_within(*options.budget_us, options.tier, most_, stature_m);
    most_ = plan_.count;
    tier_is_free_ = false;
  }
  if (plan_.tier == Tier::kSolid && !options.mu_torso_m) {
    most_ = std::min(most_, kMostSolid);
    plan_.count = std::min(plan_.count, most_);
  }
  if (!target_m_) return;
  if (tier_is_free_ && *target_m_ > kFinestPlain * stature_m) plan_.tier = Tier::kTight;
  if (plan_.tier == Tier::kRelief) {
    plan_.count = relief_count(*target_m_, stature_m, most_);
    const double ratio = predicted_gap_m(Tier::kRelief, plan_.count, stature_m) / *target_m_;
    resize(static_cast<double>(kReliefBytes) * std::pow(ratio, 1.0 / kReliefPower));
  } else {
    const GapFormula formula = gap_formula(plan_.tier);
    const double count = 89.0 * std::pow(formula.at_89 * stature_m / *target_m_, 1.0 / formula.power);
    resize(plan_.tier == Tier::kTight ? std::max(kFewestToStart, count) : count);
  }
}

bool TargetSearch::reached(double gap_m) const {
  return !target_m_ || (gap_m < kNearTarget * *target_m_ && *target_m_ < kNearTarget * gap_m);
}

double TargetSearch::size() const {
  return plan_.tier == Tier::kRelief ? static_cast<double>(plan_.relief_bytes) : plan_.count;
}

/// The size that reaches the target if the gap is a power of it. The exponent is that of the nearest tries on
/// either side of the target or, while all tries are on one side, of two of them; the tier's exponent bounds
/// it.
double TargetSearch::wanted_size(double gap_m) const {
  double power = plan_.tier == Tier::kRelief ? kReliefPower : gap_formula(plan_.tier).power;
  const Try* other = nullptr;
  const auto off = [&](const Try& t) { return std::abs(std::log(t.gap_m / *target_m_)); };
  for (const Try& t : tries_) {
    if (t.size == size()) continue;
    const bool opposite = (t.gap_m > *target_m_) != (gap_m > *target_m_);
    const bool other_is_opposite = other && (other->gap_m > *target_m_) != (gap_m > *target_m_);
    if (!other || (opposite && !other_is_opposite) || (opposite == other_is_opposite && off(t) < off(*other)))
      other = &t;
  }
  if (other) {
    const double slope = -std::log(gap_m / other->gap_m) / std::log(size() / other->size);
    if (std::isfinite(slope)) power = std::clamp(slope, 0.3 * power, 3.0 * power);
  }
  return size() * std::pow(gap_m / *target_m_, 1.0 / power);
}

bool TargetSearch::known(double wanted) const {
  return std::any_of(tries_.begin(), tries_.end(), [&](const Try& t) { return t.size == wanted; });
}

/// Changes the plan's size; false if that size was tried before.
bool TargetSearch::resize(double wanted) {
  const Plan before = plan_;
  if (plan_.tier == Tier::kRelief) {
    const double least = static_cast<double>(std::min(least_bytes(plan_.count), kReliefBytes));
    plan_.relief_bytes =
        static_cast<std::size_t>(std::clamp(wanted, least, static_cast<double>(kReliefBytes)));
  } else {
    plan_.count = static_cast<int>(std::lround(std::clamp(wanted, 1.0, static_cast<double>(most_))));
  }
  if (!known(size())) return true;
  plan_ = before;
  return false;
}

/// Changes the count by one, for when the wanted size was tried before.
bool TargetSearch::step(double gap_m) {
  return plan_.tier != Tier::kRelief && resize(plan_.count + (gap_m > *target_m_ ? 1 : -1));
}

/// Changes the count of relief, for when its tables are as large or as small as they can be.
bool TargetSearch::recount(double gap_m) {
  if (plan_.tier != Tier::kRelief) return false;
  const int count = gap_m > *target_m_ ? std::min(most_, kDefaultEllipsoids) : std::max(8, plan_.count / 2);
  if (count == plan_.count) return false;
  plan_.count = count;
  tries_.clear();
  plan_.relief_bytes = 0;
  const double full = 0.5 * static_cast<double>(kReliefBytes);
  return resize(gap_m > *target_m_ ? full : 4.0 * static_cast<double>(least_bytes(count)));
}

/// Keeps a size between the tries that enclose the target, and within half and twice the last size, because
/// fits of very few ellipsoids follow no formula.
double TargetSearch::bounded(double wanted) const {
  if (plan_.tier == Tier::kRelief) return wanted;
  double low = 1.0, high = most_;
  for (const Try& t : tries_) {
    if (t.gap_m > *target_m_) low = std::max(low, t.size + 1.0);
    if (t.gap_m <= *target_m_) high = std::min(high, t.size - 1.0);
  }
  wanted = std::clamp(wanted, 0.5 * size(), 2.0 * size());
  return low <= high ? std::clamp(wanted, low, high) : wanted;
}

bool TargetSearch::correct(double gap_m) {
  if (reached(gap_m) || ++attempts_ >= kMostAttempts || !(gap_m > 0.0)) return false;
  tries_.push_back({size(), gap_m});
  return resize(bounded(wanted_size(gap_m))) || step(gap_m) || recount(gap_m);
}

}  // namespace bodice::fitting
