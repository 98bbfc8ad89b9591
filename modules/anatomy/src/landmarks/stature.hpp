// The height of a body that need not stand.
#pragma once

#include <array>
#include <vector>

#include "landmarks/base/landmarks.hpp"

namespace bodice::inline v0_1::anatomy {

/// What shows whether a body stands.
struct Stance {
  geometry::Vec3 crown, neck, crotch, knees, ankles;  ///< the points between knees and between ankles
  std::array<geometry::Vec3, 2> toes;
};
/// The height from the lowest of the points to the crown, if the body stands and is about as tall as was
/// estimated; else the estimate. O(#points).
double stature_of(const Stance& stance, const std::vector<geometry::Vec3>& points, double estimate);

/// The height of the body as if it stood, in the mesh's unit: from sole to crown if it stands, else from
/// distances along the skin, within about 2 % (one deviation).
double find_stature(const Skin& skin, const BodyExtremities& tips, const Landmarks& marks);

}  // namespace bodice::anatomy
