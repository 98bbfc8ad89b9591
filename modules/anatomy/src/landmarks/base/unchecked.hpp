// The confidence of landmarks that have no cross-check.
#pragma once

#include "landmarks/base/landmarks.hpp"

namespace bodice::inline v0_1::anatomy {

/// The confidence as it is; on a skin that is fused somewhere so little that the landmark counts as
/// uncertain, because welds change the distances that it is found by.
inline double unchecked_confidence(const LandmarkInput& input, double confidence) {
  constexpr double kFused = 0.3;
  return input.fused() ? kFused * confidence : confidence;
}

}  // namespace bodice::anatomy
