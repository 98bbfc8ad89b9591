// Directions that belong to the trunk.
#pragma once

#include "landmarks/base/landmarks.hpp"

namespace bodice::inline v0_1::anatomy {

/// Unit vectors of the trunk: to the body's left, from perineum to neck, and to the front.
struct TrunkFrame {
  geometry::Vec3 left, up, forward;

  geometry::Vec3 coordinates(const geometry::Vec3& v) const {
    return {v.dot(left), v.dot(up), v.dot(forward)};
  }
};

/// The frame of the trunk, by neck, perineum and armpits as found so far.
inline TrunkFrame trunk_frame(const Landmarks& marks) {
  const geometry::Vec3 up = (marks.at(LandmarkId::kNeck) - marks.at(LandmarkId::kPerineum)).normalized();
  const geometry::Vec3 across = marks.at(LandmarkId::kArmpitL) - marks.at(LandmarkId::kArmpitR);
  const geometry::Vec3 left = (across - across.dot(up) * up).normalized();
  return {left, up, left.cross(up)};
}

}  // namespace bodice::anatomy
