// The triangles of one leaf side by side in floats, to find those that can be nearer than a bound.
#pragma once

#include <array>
#include <cstdint>

#include <bodice/geometry/detail/float4.hpp>
#include <bodice/geometry/types.hpp>

namespace bodice::inline v0_1::geometry {

/// A triangle in the form that the traversal reads: a corner and two edges, in the local frame.
struct BvhTriangle {
  Vec3 a, ab, ac;
};

/// A leaf of up to four triangles in local units, each in a frame of its own: corner a is the origin, b lies
/// on the x axis and c above it.
struct LeafTriangles {
  static constexpr int kWidth = 4;

  std::uint32_t first = 0, count = 0;   ///< a range of the tree's triangles
  std::array<Float4, 3> a{}, x{}, y{};  ///< corner, and the frame's axes in the plane; a sliver's axes are 0
  Float4 bx{}, cx{}, cy{};
  Float4 per_ac2{}, per_bc2{};  ///< 1 / squared length

  void set(int slot, const BvhTriangle& t);

  /// Squared distances of a point from the triangles. If the point is rounded to floats and coordinates are
  /// at most m, their roots exceed the true ones by at most kSlack (m + 1). Those of slivers are below the
  /// true ones.
  Float4 distances2(const std::array<float, 3>& point) const;
  static constexpr double kSlack = 64.0 * 0x1p-23;

  /// Half of the solid angle of each triangle as seen from a point, in (-pi, pi), in radians, within 2e-5 of
  /// the exact one; 0 for slivers. `near` is set for triangles in which the point nearly lies: their sign is
  /// not known in floats.
  Float4 half_solid_angles(const std::array<float, 3>& point, Int4& near) const;
};

}  // namespace bodice::geometry
