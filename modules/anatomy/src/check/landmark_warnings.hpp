// Warnings about single landmarks.
#pragma once

#include <bodice/engine/result.hpp>

#include "landmarks/find_landmarks.hpp"

namespace bodice::inline v0_1::anatomy {

/// Adds a warning for each landmark with little confidence and for each cross-check that contradicts its
/// landmark.
void warn_of_landmarks(const CheckedLandmarks& landmarks, std::vector<engine::Warning>& warnings);

}  // namespace bodice::anatomy
