#pragma once

#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::geometry {

/// Which feature of a triangle holds a point.
enum class TriangleFeature : std::uint8_t { kFace, kEdge01, kEdge12, kEdge20, kVertex0, kVertex1, kVertex2 };

struct TrianglePoint {
  Vec3 point = Vec3::Zero();
  Vec3 barycentric = Vec3::UnitX();  ///< weights of the three corners, sum 1, each >= 0
  TriangleFeature feature = TriangleFeature::kVertex0;
};

/// The closest point of triangle abc. Degenerate triangles act as their longest edge or their point. No NaN
/// for finite input whose squares do not overflow.
TrianglePoint closest_point(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& query);

/// The solid angle that triangle abc spans seen from `apex`, in (-2 pi, 2 pi); positive when the apex lies on
/// the inner side (the triangle is counter-clockwise seen from outside). 0 when the apex lies on its plane
/// outside the triangle, or on an edge.
double solid_angle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& apex);

}  // namespace bodice::geometry
