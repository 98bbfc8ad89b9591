// Where a table yields to other ellipsoids in a pose because its skin has left it: there the table is right
// along few directions only, and an ellipsoid that the skin stayed with errs less.
#pragma once

#include "tolerances.hpp"

namespace bodice::inline v0_1::binding {

/// The growths from which a table yields, and by how much at most, meters.
struct YieldRule {
  float sinking_m = 0.0f, rising_m = 0.0f, most_m = 0.0f;
};

/// The rule of an ellipsoid in a pose. `out_m` is the reach of relief at rest.
inline YieldRule yield_rule(double out_m, double scale) {
  const double reach_m = out_m * scale;
  return {static_cast<float>(kMostSinking * reach_m), static_cast<float>(kMostRising * reach_m),
          static_cast<float>(kMostYield * reach_m)};
}

/// Added to the score of a table that has grown so much, meters. Loops over it become vector code.
inline __attribute__((always_inline)) float yield_m(const YieldRule& rule, float growth_m) {
  const float risen = growth_m - rule.rising_m, sunk = -growth_m - rule.sinking_m;
  const float beyond = risen > sunk ? risen : sunk;
  const float some = beyond > 0.0f ? beyond : 0.0f;
  return some < rule.most_m ? some : rule.most_m;
}

}  // namespace bodice::binding
