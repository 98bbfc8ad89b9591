#pragma once

#include <vector>

#include <bodice/geometry/ellipsoid.hpp>

namespace bodice::inline v0_1::fitting {

/// The surface area of an ellipsoid, square meters, within 1.1 %: it only distributes samples.
/// Based on: Knud Thomsen. Surface area of an ellipsoid, an approximate formula. 2004.
double surface_area(const geometry::Vec3& radii);

/// A point of a surface with the area that it represents.
struct SurfaceProbe {
  geometry::Vec3 point;
  double area = 0.0;
};

/// About even points of an ellipsoid: Fibonacci directions on the unit sphere, with the area that each maps
/// to.
std::vector<SurfaceProbe> probe_surface(const geometry::Ellipsoid& ellipsoid, int count);

}  // namespace bodice::fitting
