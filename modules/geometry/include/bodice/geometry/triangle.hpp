#pragma once

#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::inline v0_1::geometry {

/// The feature of a triangle that holds a point: its face, an edge or a corner.
enum class TriangleFeature : std::uint8_t { kFace, kEdge01, kEdge12, kEdge20, kVertex0, kVertex1, kVertex2 };

/// A point of a triangle, as a position and as weights of the corners.
struct TrianglePoint {
  Vec3 point = Vec3::Zero();
  Vec3 barycentric = Vec3::UnitX();  ///< weights of the three corners, sum 1, each >= 0
  TriangleFeature feature = TriangleFeature::kVertex0;
};

/// The closest point of triangle abc. Degenerate triangles act as their longest edge or their point. The
/// result is not NaN for finite input with squares in the range of double.
TrianglePoint closest_point(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& query);

/// The solid angle that triangle abc spans seen from `apex`, in (-2 pi, 2 pi). It is positive when the apex
/// lies on the inner side (the triangle is counter-clockwise seen from outside), and 0 when the apex lies on
/// an edge or on the plane outside the triangle.
double solid_angle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& apex);

}  // namespace bodice::geometry
