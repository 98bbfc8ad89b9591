// What may be wrong with a body or with what was found on it.
#pragma once

#include <bodice/body/proportions.hpp>
#include <bodice/engine/result.hpp>

#include "landmarks/find_landmarks.hpp"

namespace bodice::inline v0_1::anatomy {

/// What the analysis found on one skin, step by step.
struct Findings {
  const Skin& skin;
  const Extremities& extremities;
  const Sides& sides;
  const BodyCoordinates& coordinates;
  const CheckedLandmarks& landmarks;
};

/// Warnings about the surface, welds, asymmetry, landmarks and proportions. O(1) after what was found.
std::vector<engine::Warning> diagnose(const Findings& found, const body::ProportionProfile& profile,
                                      double stature_m);

}  // namespace bodice::anatomy
