// The shared table of hostile input, which every algorithm's suite iterates over.
//
//   for (const PointSetCase& extreme : extreme_point_sets()) {
//     CAPTURE(extreme.name);
//     const auto result = algorithm(extreme.points);
//     if (!extreme.finite) CHECK(an error that names them, or a result without those points);
//     else CHECK(no NaN, and the algorithm's own promise, with tolerances relative to extreme.size_m);
//   }
//
// The expected result depends on the algorithm. The table states what the input IS (how many dimensions it
// spans, how large, how far, whether finite), and the suite states what must come out.
#pragma once

#include <string>
#include <vector>

#include <bodice/geometry/ellipsoid.hpp>
#include <bodice/geometry/tri_mesh.hpp>

namespace bodice_test {

using bodice::geometry::Ellipsoid;
using bodice::geometry::TriMesh;
using bodice::geometry::Vec3;

struct PointSetCase {
  std::string name;
  std::vector<Vec3> points;
  bool finite = true;     ///< no NaN or Inf among the points
  int dimension = 3;      ///< of the affine hull of the finite points; -1 without points
  double size_m = 0.0;    ///< diagonal of the finite points' box
  double offset_m = 0.0;  ///< distance of their box from the origin: doubles resolve 1e-16 of it, no more
};

/// 0..4 points, duplicates, collinear, coplanar, lattices, needles to 1e6, tiny clusters with outliers; the
/// solid ones also at scales 1e-6..1e6 and 10 km from the origin; NaN and Inf mixed in. Deterministic.
const std::vector<PointSetCase>& extreme_point_sets();

struct EllipsoidCase {
  std::string name;
  Ellipsoid shape;
};

/// Spheres, aspects to 1e6 (prolate, oblate, triaxial), equal and nearly equal radii, scales 1e-6..1e6,
/// rotated, 10 km from the origin.
const std::vector<EllipsoidCase>& extreme_ellipsoids();

/// Queries that break formulas for this ellipsoid: its center, axes, symmetry planes, medial disk and its
/// rim, a rounding away from each, on, just inside and just outside the surface, and 10 km away.
std::vector<Vec3> hostile_queries(const Ellipsoid& ellipsoid);

struct MeshCase {
  std::string name;
  TriMesh mesh;
  bool usable = true;  ///< a triangle with an area is left after repair
};

/// Empty, one triangle, flat, degenerate, duplicate, reversed, non-manifold, bad indices, NaN and Inf
/// vertices, a stray vertex and a stray component far away, needles, scales 1e-6..1e6, 10 km from the origin.
const std::vector<MeshCase>& extreme_meshes();

/// Doubles that break arithmetic, finite and not: zeros of both signs, subnormal, 1e-300..1e300, NaN, Inf.
const std::vector<double>& extreme_values();

}  // namespace bodice_test
