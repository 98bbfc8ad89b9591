#pragma once

#include <limits>

#include <bodice/engine/function_ref.hpp>
#include <bodice/geometry/triangle.hpp>

#include "distance/bvh.hpp"

namespace bodice::inline v0_1::geometry {

struct BvhHit {
  double distance2 = std::numeric_limits<double>::infinity();  ///< local units squared
  std::uint32_t leaf_triangle = ~0u;                           ///< leaf order
  TrianglePoint at;                                            ///< in the local frame
};

/// The closest triangle that is nearer than sqrt(limit2) to a query in the local frame. If there is none,
/// leaf_triangle stays ~0.
BvhHit nearest_triangle(const Bvh& bvh, const Vec3& local_query, double limit2);
/// The same among the triangles of the mesh for which counts(triangle) holds.
BvhHit nearest_triangle(const Bvh& bvh, const Vec3& local_query, double limit2,
                        engine::FunctionRef<bool(Index)> counts);

}  // namespace bodice::geometry
