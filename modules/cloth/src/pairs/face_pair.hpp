// Quick proofs that parts of the cloth are apart. A plane proves it for two triangles, and the normals for a
// patch.
#pragma once

#include "pairs/closest.hpp"
#include "pairs/contact_mesh.hpp"

namespace bodice::inline v0_1::cloth {

/// The corners of two triangles.
struct FacePair {
  Float4 a[3], b[3];      ///< meters
  int shared[3][2] = {};  ///< indices of corners of a and b that are the same particle
  int common = 0;         ///< number of common particles
};

FacePair face_pair(const Face& a, const Face& b, std::span<const Point> at);

/// A lower bound of the distance of two triangles without common particles, meters: that of two parallel
/// planes between them, at right angles to the line of their middles. Zero where there are no such planes.
float least_apart(const FacePair& pair);

/// For two triangles with common particles: whether a plane proves that all other corners, and the edges
/// between these, are farther apart than `reach_m`. It assumes that triangles with a common edge are no
/// slivers.
bool are_clear(const FacePair& pair, float reach_m);

/// How far the parts of two joined leaves (are_joined()) may move against each other, meters, before the
/// leaves can fold until they touch. It is zero where they are not flat now; in a flat patch all normals are
/// within 60 degrees of their mean. A flat patch may still lie over itself where triangles of other leaves
/// between its own have turned over.
/// Based on: Pascal Volino, Nadia Magnenat-Thalmann. Efficient Self-Collision Detection on Smoothly
/// Discretized Surface Animations using Geometrical Shape Regularity. 1994.
/// Differs: outlines are not tested, because a flat patch of so few triangles does not wind around itself.
float travel_while_flat(const ContactMesh& mesh, std::size_t leaf, std::size_t other,
                        std::span<const Point> at);

}  // namespace bodice::cloth
