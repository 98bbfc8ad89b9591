#include "plan.hpp"

#include <algorithm>
#include <cmath>

namespace bodice::fitting {
namespace {

/// Mean gap at 89 ellipsoids as a fraction of stature, by tier.
double gap_at_89(proxy::Tier tier) {
  switch (tier) {
    case proxy::Tier::kPaper:
      return 0.0090;
    case proxy::Tier::kSolid:
      return 0.0075;
    case proxy::Tier::kTight:
      return 0.00075;
    case proxy::Tier::kRelief:
      return 0.0002;
  }
  return 0.0090;
}

}  // namespace

double predicted_frame_us(proxy::Tier tier, int ellipsoids) {
  // 10,000 particles: nanoseconds a particle times ten.
  return tier == proxy::Tier::kRelief ? 10.0 * (14.0 + 0.30 * ellipsoids) : 10.0 * (2.0 + 0.065 * ellipsoids);
}

int count_within_budget(proxy::Tier tier, double budget_us) {
  int count = 1;
  while (count < kMostEllipsoids && predicted_frame_us(tier, count + 1) <= budget_us) ++count;
  return count;
}

double predicted_gap_m(proxy::Tier tier, int ellipsoids, double stature_m) {
  return gap_at_89(tier) * stature_m * std::sqrt(89.0 / std::max(1, ellipsoids));
}

int count_for_error(proxy::Tier tier, double target_error_m, double stature_m) {
  const double ratio = predicted_gap_m(tier, kDefaultEllipsoids, stature_m) / target_error_m;
  const double count = std::ceil(kDefaultEllipsoids * ratio * ratio);
  return static_cast<int>(std::clamp(count, 1.0, static_cast<double>(kMostEllipsoids)));
}

}  // namespace bodice::fitting
