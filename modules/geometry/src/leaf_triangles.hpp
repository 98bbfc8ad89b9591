// The triangles of one leaf side by side in floats: which of them can be nearer than a bound.
#pragma once

#include <array>
#include <cstdint>

#include <bodice/geometry/detail/float4.hpp>
#include <bodice/geometry/types.hpp>

namespace bodice::geometry {

/// A triangle as the traversal wants it: a corner and two edges, local frame.
struct BvhTriangle {
  Vec3 a, ab, ac;
};

/// Up to four triangles, each in a frame of its own: corner a at the origin, b on the x axis, c above it.
/// Local units of the tree.
struct LeafTriangles {
  static constexpr int kWidth = 4;

  std::uint32_t first = 0, count = 0;   ///< of the tree's triangles
  std::array<Float4, 3> a{}, x{}, y{};  ///< corner, and the frame's axes in the plane; a sliver's axes are 0
  Float4 bx{}, cx{}, cy{};
  Float4 per_ac2{}, per_bc2{};  ///< 1 / squared length

  void set(int slot, const BvhTriangle& t);

  /// Squared distances of a point. With those points rounded to floats and coordinates up to m, their roots
  /// are too large by no more than kSlack (m + 1); those of slivers are below the true ones.
  Float4 distances2(const std::array<float, 3>& point) const;
  static constexpr double kSlack = 64.0 * 0x1p-23;
};

}  // namespace bodice::geometry
