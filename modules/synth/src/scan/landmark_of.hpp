// A landmark of a body by its name.
#pragma once

#include <bodice/synth/body.hpp>

namespace bodice::inline v0_1::synth {

/// The true position of a landmark, or zero where a body has none of this name.
inline geometry::Vec3 landmark_of(const Body& body, body::LandmarkId id) {
  for (const auto& mark : body.landmarks)
    if (mark.id == id) return mark.position;
  return geometry::Vec3::Zero();
}

}  // namespace bodice::synth
