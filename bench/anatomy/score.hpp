#pragma once

#include <bodice/anatomy/anatomy.hpp>

#include "cases.hpp"

namespace bench {

/// How far a landmark may lie from the truth, of the stature.
inline constexpr double kRestBar = 0.025, kPosedBar = 0.04;

struct Score {
  double agreement = -1.0;              ///< share of the skin's area, borders left out; -1 without truth
  double swapped = 0.0;                 ///< share of the limbs' area that has the other side's label
  std::map<std::string, double> error;  ///< of each landmark, of the stature
  double worst_landmark = -1.0;
  std::string worst_name;
  double stature_ratio = -1.0;  ///< found to true
};

Score score(const Case& c, const bodice::anatomy::Anatomy& anatomy);

}  // namespace bench
