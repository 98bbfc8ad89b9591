// Quick proofs that parts of the cloth stay apart: of two triangles by a plane, of a patch by its normals.
#pragma once

#include "pairs/closest.hpp"
#include "pairs/contact_mesh.hpp"

namespace bodice::inline v0_1::cloth {

/// The corners of two triangles.
struct FacePair {
  Float4 a[3], b[3];      ///< meters
  int shared[3][2] = {};  ///< corners of a and b that are the same particle
  int common = 0;         ///< number of those
};

FacePair face_pair(const Face& a, const Face& b, std::span<const Point> at);

/// How far apart two triangles without common particles are at least, meters: the distance of two planes
/// between them, across the line of their middles. Zero where there are no such planes.
float least_apart(const FacePair& pair);

/// Whether a plane proves that those parts of two triangles with common particles which have none of these in
/// common are farther apart than `reach_m`. Triangles with a common edge are taken for no slivers.
bool are_clear(const FacePair& pair, float reach_m);

/// How far the parts of two joined leaves (are_joined()) may move against each other, meters, before the
/// leaves can touch each other by turning. Zero where they are not flat now: a flat patch has all normals
/// within an angle of their mean. It may still lie over itself where triangles between its own, of other
/// leaves, have turned over. Based on: Pascal Volino, Nadia Magnenat-Thalmann. Efficient Self-Collision
/// Detection on Smoothly Discretized Surface Animations using Geometrical Shape Regularity. 1994. Differs:
/// outlines are not tested, because a flat patch of so few triangles does not wind around itself.
float flat_for(const ContactMesh& mesh, std::size_t leaf, std::size_t other, std::span<const Point> at);

}  // namespace bodice::cloth
