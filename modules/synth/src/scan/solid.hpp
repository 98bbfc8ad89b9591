// What a scan's surface is put around.
#pragma once

#include <vector>

#include <bodice/geometry/contour.hpp>

namespace bodice::inline v0_1::synth {

/// A solid by its signed distance, negative inside.
struct Solid {
  geometry::DistanceField distance;
  geometry::Box box;  ///< contains the solid; empty for one that lies within another's box

  /// Adds another solid.
  void add(const Solid& other);
};

/// Boxes as one solid.
Solid solid_of(const std::vector<geometry::Box>& boxes);

}  // namespace bodice::synth
