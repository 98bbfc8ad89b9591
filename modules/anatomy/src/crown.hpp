// The top of the head.
#pragma once

#include "landmarks.hpp"

namespace bodice::anatomy {

struct Crown {
  geometry::Vec3 place = geometry::Vec3::Zero();
  geometry::Index vertex = geometry::kNoIndex;
};

/// Of the head's outer skin, the place that is far from both feet and as far from the back of the neck as
/// from its front; the head's end itself where no neck was found. O(#F).
Crown find_crown(const Skin& skin, const BodyCoordinates& coordinates, const Girth& neck);

}  // namespace bodice::anatomy
