#pragma once

#include <vector>

#include <bodice/geometry/ellipsoid.hpp>

namespace bodice::fitting {

/// Square meters. Based on: Knud Thomsen's approximation, within 1.1 %: only shares samples out.
double surface_area(const geometry::Vec3& radii);

struct SurfaceProbe {
  geometry::Vec3 point;
  double area = 0.0;  ///< that it stands for
};

/// About even points: Fibonacci directions on the unit sphere, with the area that each maps to.
std::vector<SurfaceProbe> probe_surface(const geometry::Ellipsoid& ellipsoid, int count);

}  // namespace bodice::fitting
