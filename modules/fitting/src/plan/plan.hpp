// From the one number a user gives to a tier, a number of ellipsoids and a size of tables.
#pragma once

#include <vector>

#include <bodice/fitting/budget.hpp>
#include <bodice/fitting/fit.hpp>

namespace bodice::fitting {

/// Ellipsoids when nothing is asked for: the largest count of the paper's Table 2.
inline constexpr int kDefaultEllipsoids = 89;
/// A target error may ask for up to this many.
inline constexpr int kMostEllipsoids = 400;

struct Plan {
  proxy::Tier tier = proxy::Tier::kRelief;
  int count = kDefaultEllipsoids;
  std::size_t relief_bytes = 0;  ///< of the whole proxy with its tables; relief only
};

/// A budget is kept within a fifth, or there is a warning.
inline constexpr double kBudgetKeptTo = 1.2;

/// The largest count whose predicted time is within the budget, at least 1.
int count_within_budget(proxy::Tier tier, double budget_us);

/// Mean gap to expect at a count, meters, for a body of this stature; relief with full tables.
double predicted_gap_m(proxy::Tier tier, int ellipsoids, double stature_m);

/// The search for a plan: tries one, is told what it achieved, tries the next. A target error changes the
/// count of the plain tiers and the bytes of relief, because new tables on the same ellipsoids are cheap.
class Dial {
 public:
  Dial(const FitOptions& options, double stature_m);

  const Plan& plan() const { return plan_; }
  /// Whether a gap is as near to the target as the dial promises: a tenth above or below.
  bool reached(double gap_m) const;
  /// Takes the gap of the plan just tried; false if there is nothing left to try.
  bool correct(double gap_m);

 private:
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
  std::vector<Try> tries_;  ///< with the plan's tier and, for relief, its count
  int attempts_ = 0;
};

}  // namespace bodice::fitting
