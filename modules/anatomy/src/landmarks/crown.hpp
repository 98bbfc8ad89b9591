// The top of the head.
#pragma once

#include "landmarks/landmarks.hpp"
#include "skin/ball.hpp"

namespace bodice::anatomy {

struct Crown {
  geometry::Vec3 place = geometry::Vec3::Zero();
  geometry::Index vertex = geometry::kNoIndex;  ///< of the skin, nearest to the place
};

/// The ball that the head above the neck's border resembles. O(#F).
Ball head_ball(const Skin& skin, const BodyCoordinates& coordinates);

/// Of the head's outer skin, the place that is far from both feet and as far from the back of the neck as
/// from its front, moved by what the lengths of body and head tell; the head's end itself where no neck was
/// found. O(#F).
Crown find_crown(const Skin& skin, const BodyCoordinates& coordinates, const Girth& neck, const Ball& head);

}  // namespace bodice::anatomy
