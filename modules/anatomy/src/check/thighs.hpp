// How far the thighs of an analyzed body are bent.
#pragma once

#include <array>
#include <cstddef>

#include <bodice/anatomy/anatomy.hpp>

namespace bodice::inline v0_1::anatomy {

/// A body stands if the cosines of both thighs reach this.
inline constexpr double kUpright = 0.75;
/// A body that reaches this strides, or stands: those of made scans have .68 and more.
inline constexpr double kNotBent = 0.6;

/// Cosines between the left and the right thigh and the line from perineum to neck: near 1 for a body that
/// stands, near 0 for one that sits.
inline std::array<double, 2> thigh_cosines(const Anatomy& anatomy) {
  const auto at = [&](body::LandmarkId id) {
    return anatomy.landmarks[static_cast<std::size_t>(id)].position;
  };
  const auto cosine = [&](body::LandmarkId knee) {
    return (at(body::LandmarkId::kPerineum) - at(knee)).normalized().dot(anatomy.up);
  };
  return {cosine(body::LandmarkId::kKneeL), cosine(body::LandmarkId::kKneeR)};
}

}  // namespace bodice::anatomy
