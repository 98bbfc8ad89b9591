// An algorithm's error at one place of the sweep: one curve is a row of the table.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <bodice/geometry/tri_mesh.hpp>

namespace extremes_bench {

/// Where the input is put. One of the three is swept, the others stay at home.
struct Place {
  double scale_m = 1.0;  ///< size of the input
  double offset = 0.0;   ///< distance from the origin in sizes, along an oblique direction
  double aspect = 1.0;   ///< longest over shortest extent; the middle one is their geometric mean

  /// Radii or half sizes of 1 : 1/sqrt(aspect) : 1/aspect.
  bodice::geometry::Vec3 extents_m() const;
  bodice::geometry::Vec3 center_m() const;
  /// What no axis is parallel to.
  static bodice::geometry::Mat3 turn();
  /// Into the world: turned and moved.
  bodice::geometry::Vec3 put(const bodice::geometry::Vec3& local_m) const;
};

/// What a curve is drawn against; as bits.
enum Sweep : unsigned { kScale = 1, kOffset = 2, kAspect = 4 };

struct Curve {
  std::string algorithm, error;  ///< the error is a ratio: to the size, or to what is said
  std::function<double(const Place&)> at;
  unsigned sweeps = kScale | kOffset | kAspect;
};

std::vector<Curve> point_curves();      ///< enclosing ellipsoids, clusters
std::vector<Curve> ellipsoid_curves();  ///< closest points, queries, responses
std::vector<Curve> mesh_curves();       ///< distance to a mesh, distances along it
std::vector<Curve> body_curves();       ///< anatomy, all tiers of fitting, cloth

}  // namespace extremes_bench
