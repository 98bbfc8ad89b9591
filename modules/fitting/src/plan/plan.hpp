// Finds a tier, a count and a size of tables by the one number that a user gives: a target error or a budget.
#pragma once

#include <vector>

#include <bodice/fitting/cost_model.hpp>
#include <bodice/fitting/fit.hpp>

namespace bodice::inline v0_1::fitting {

/// The number of ellipsoids by default: the largest count of the paper's Table 2.
inline constexpr int kDefaultEllipsoids = 89;
/// A target error may lead to up to this many ellipsoids.
inline constexpr int kMostEllipsoids = 400;

/// A gap within this factor of the target error has reached it.
inline constexpr double kNearTarget = 1.10;

/// What a fit runs with.
struct Plan {
  proxy::Tier tier = proxy::Tier::kRelief;
  int count = kDefaultEllipsoids;
  std::size_t relief_bytes = 0;  ///< limit for the proxy with its tables; relief only
};

/// The predicted time may exceed the budget by this factor; beyond it there is a warning.
inline constexpr double kBudgetKeptTo = 1.2;

/// The largest count with a predicted time within the budget, at least 1.
int count_within_budget(proxy::Tier tier, double budget_us);

/// The mean gap to expect with so many ellipsoids, meters, for a body of this stature; relief with full
/// tables.
double predicted_gap_m(proxy::Tier tier, int ellipsoids, double stature_m);

/// The target search: it proposes a plan, takes the gap that the plan gave, and proposes the next one. A
/// target error changes the count of the plain tiers and the bytes of relief, because other tables on the
/// same ellipsoids are cheap.
class TargetSearch {
 public:
  TargetSearch(const FitOptions& options, double stature_m);

  const Plan& plan() const { return plan_; }
  /// Whether a gap is within a tenth of the target.
  bool reached(double gap_m) const;
  /// Takes the gap of the current plan and proposes another plan; false if none is left to try.
  bool correct(double gap_m);

 private:
  /// A plan that was tried: its size() and the gap that it gave.
  struct Try {
    double size, gap_m;
  };

  double size() const;
  double wanted_size(double gap_m) const;
  double bounded(double wanted) const;
  bool known(double size) const;
  bool resize(double size);
  bool step(double gap_m);
  bool recount(double gap_m);

  std::optional<double> target_m_;
  int most_ = kMostEllipsoids;
  bool tier_is_free_ = false;
  Plan plan_;
  std::vector<Try> tries_;  ///< those of the plan's tier and, for relief, of its count
  int attempts_ = 0;
};

}  // namespace bodice::fitting
