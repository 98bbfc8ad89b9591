// Convex pieces that cover a body together, for programs that have no other shapes.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <bodice/colliders/reduce.hpp>

namespace bodice::inline v0_1::colliders {

/// The convex hull of a piece of the skin: closed, wound outward, every edge with two triangles.
struct ConvexPiece {
  geometry::TriMesh mesh;  ///< at rest, meters, y up; at most kMostCorners vertices
  body::Part part = body::Part::kHead;
  std::int16_t bone = proxy::kNoBone;  ///< into Binding::joint_names
};

/// What engines with the narrowest limits take of a hull.
inline constexpr int kMostCorners = 64;

/// Makes at most `count` pieces: the skin is divided as capsules of reduce() divide it, with a little of the
/// neighbors' so that no slit stays between pieces. Of each piece the farthest points in kMostCorners
/// directions count. Fails as reduce() does. Deterministic for any number of workers.
engine::Result<std::vector<ConvexPiece>> convex_pieces(const engine::Context& context,
                                                       const proxy::BodyProxy& proxy,
                                                       const SkinPoints& points, int count);

/// The cost of pieces: a point's distance is its least signed distance to any of them.
ReductionCost cost_of_pieces(const engine::Context& context, const proxy::BodyProxy& proxy,
                             const SkinPoints& points, std::span<const ConvexPiece> pieces);

/// glTF with its data inside: meters, y up, a node a piece, below the node of its joint and in the
/// coordinates of that. Nodes have `extras`: part, bone and hash.
std::string convex_gltf(const proxy::BodyProxy& proxy, std::span<const ConvexPiece> pieces);
/// OBJ in the unit and axes of the proxy's body, an object a piece.
std::string convex_obj(const proxy::BodyProxy& proxy, std::span<const ConvexPiece> pieces);

/// The convex hull of points; empty where they lie in a plane. Every edge has two triangles. Points within
/// a billionth of the largest extent inside of it are no vertices. O(n #hull).
geometry::TriMesh convex_hull(std::span<const Vec3> points);

}  // namespace bodice::colliders
