// The minimum-volume enclosing ellipsoid of a point set, with a certificate.
#pragma once

#include <cstddef>
#include <span>

#include <bodice/geometry/ellipsoid.hpp>

namespace bodice::inline v0_1::fitting {

using geometry::Vec3;

/// A set thinner than this fraction of its largest half-extent is flat in that direction: below it, rounding
/// of the coordinates decides the shape.
inline constexpr double kFlatRelative = 1e-10;

/// How exact an enclosing ellipsoid has to be.
struct MveeOptions {
  double volume_tolerance =
      1e-7;                   ///< the solver stops when ln(volume / least volume) is certified below this
  double min_radius_m = 0.0;  ///< no semi-axis is shorter; 0: kFlatRelative of the longest
};

/// An ellipsoid that holds every point, and how far from the smallest it can be.
struct Mvee {
  geometry::Ellipsoid ellipsoid;
  int rank = 0;  ///< dimension of the set's affine hull, 0..3; the gap is measured in that dimension
  double volume_gap = 0.0;  ///< ln(volume / least volume) is at most this (duality)
  double violation = 0.0;   ///< max over the points of sqrt(level) - 1, at least 0, as re-measured at the end
  int rounds = 0;           ///< scans over all points
  std::size_t skipped = 0;  ///< points with NaN or Inf
};

/// The active-set solution, exact to options.volume_tolerance. Flat, collinear, single and empty sets give a
/// thin ellipsoid with the minimum radius, never NaN. Cost: O(#points) a round, about 5 to 20 rounds.
Mvee mvee(std::span<const Vec3> points, const MveeOptions& options = {});

/// The first-order solution with away steps, cheaper where a loose ellipsoid will do. It stops when the
/// certified gap is below `epsilon`, or after 10,000 steps with the gap that is certified then. Cost:
/// O(#points) a step.
Mvee mvee_first_order(std::span<const Vec3> points, double epsilon, double min_radius_m = 0.0);

}  // namespace bodice::fitting
