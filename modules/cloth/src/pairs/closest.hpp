// The closest points of two parts of the cloth, as self-contact needs them: a particle and a triangle, or two
// edges.
// Based on: Christer Ericson. Real-Time Collision Detection. 2005. - sections 5.1.5 and 5.1.9
#pragma once

#include "base/float4.hpp"
#include "base/tolerances.hpp"

namespace bodice::inline v0_1::cloth {

/// The vector with length 1; zero where it has none.
inline Float4 unit(Float4 v) {
  return v / __builtin_sqrtf(dot(v, v) + kTinyLength2);
}

/// Four positions: those of part A, then those of part B. A particle is one, an edge two, a triangle three.
struct Corners {
  Float4 at[4];
};

/// The closest points of parts A and B.
struct Closest {
  Float4 weight = {};    ///< shares of the corners: A's sum to 1, B's to -1
  Float4 apart = {};     ///< from the point of B to that of A, meters
  float length2 = 0.0f;  ///< the square of the length of `apart`, square meters
};

/// The closest points of the particle at[0] and the triangle of the others.
Closest closest_on_triangle(const Corners& corners);
/// The closest points of the edges at[0], at[1] and at[2], at[3].
Closest closest_of_edges(const Corners& corners);

inline Closest closest(bool edges, const Corners& corners) {
  return edges ? closest_of_edges(corners) : closest_on_triangle(corners);
}

/// The least distance of A from B along the unit vector `normal`, meters. It is positive where a plane across
/// the normal separates them.
inline float separation(bool edges, const Corners& corners, Float4 normal) {
  const float d0 = dot(corners.at[0], normal), d1 = dot(corners.at[1], normal),
              d2 = dot(corners.at[2], normal), d3 = dot(corners.at[3], normal);
  const float b = d2 > d3 ? d2 : d3;
  return edges ? (d0 < d1 ? d0 : d1) - b : d0 - (d1 > b ? d1 : b);
}

/// Whether the parts may come nearer than `least_m` while their corners move straight by `by` from `from`. It
/// returns true as well where it cannot prove that they do not. Precondition: they are farther apart at the
/// start.
bool may_meet(bool edges, Corners from, const Corners& by, float least_m);

}  // namespace bodice::cloth
