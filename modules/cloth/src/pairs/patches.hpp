// How triangles of a garment join along edges, and small patches of them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::inline v0_1::cloth {

using geometry::Index;

inline constexpr std::uint32_t kNoTriangle = ~std::uint32_t{0};

/// Triangles joined by edges that have exactly two of them.
struct Joints {
  std::vector<std::array<std::uint32_t, 3>> across;  ///< #F: the triangle across each edge, or kNoTriangle
  std::vector<std::uint8_t> owned;                   ///< #F: bit k: the first triangle that has edge k
  std::vector<bool> turned;  ///< #F: whether the winding is against that of the surface's first triangle
};

/// Finds which triangles share edges, and a consistent winding for each surface that has one. O(n log n).
Joints find_joints(const geometry::TriMesh& mesh);

/// Splits triangles into connected patches of at most `most` with the same group; each begins at the first
/// triangle left in `order`, and the patches follow that order.
std::vector<std::vector<std::uint32_t>> split_into_patches(const Joints& joints,
                                                           const std::vector<std::uint32_t>& order,
                                                           const std::vector<std::size_t>& group,
                                                           std::size_t most);

}  // namespace bodice::cloth
