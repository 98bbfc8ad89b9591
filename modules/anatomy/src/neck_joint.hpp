// Where the neck turns, inside the loop of its border.
#pragma once

#include "landmarks.hpp"

namespace bodice::anatomy {

/// The loop's centre, moved to the joint: raised arms lift the border, a large head brings it forward, and
/// the body's own lengths tell how far. O(1).
geometry::Vec3 neck_joint(const Skin& skin, const BodyCoordinates& coordinates, const Girth& loop);

}  // namespace bodice::anatomy
