// The error of an algorithm as a function of the input's scale, offset and aspect.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <bodice/geometry/tri_mesh.hpp>

namespace extremes_bench {

/// How the input is scaled, moved and flattened. A sweep varies one of the three; the others keep their
/// defaults.
struct Placement {
  double scale_m = 1.0;  ///< size of the input
  double offset = 0.0;   ///< distance from the origin in sizes, along an oblique direction
  double aspect = 1.0;   ///< longest over shortest extent; the middle one is their geometric mean

  /// Radii or half sizes of the input, in the ratio 1 : 1/sqrt(aspect) : 1/aspect.
  bodice::geometry::Vec3 extents_m() const;
  bodice::geometry::Vec3 center_m() const;
  /// A rotation that leaves no axis of the input parallel to a coordinate axis.
  static bodice::geometry::Mat3 turn();
  /// Rotates and moves a point of the input to the world.
  bodice::geometry::Vec3 to_world(const bodice::geometry::Vec3& local_m) const;
};

/// The quantity that a sweep varies, as bits.
enum Sweep : unsigned { kScale = 1, kOffset = 2, kAspect = 4 };

/// A row of the tables: an algorithm, its measure of error, and the sweeps in which it appears.
struct Curve {
  std::string algorithm, error;  ///< the error is a ratio, to the size or to the quantity in its name
  std::function<double(const Placement&)> at;
  unsigned sweeps = kScale | kOffset | kAspect;
};

std::vector<Curve> point_curves();      ///< enclosing ellipsoids, clusters
std::vector<Curve> ellipsoid_curves();  ///< closest points, queries, responses
std::vector<Curve> mesh_curves();       ///< distance to a mesh, distances along it
std::vector<Curve> body_curves();       ///< anatomy, all tiers of fitting, cloth

}  // namespace extremes_bench
