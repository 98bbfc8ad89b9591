// A garment's mesh as files with textures need it: where a seam of the texture runs through a vertex, there
// is a vertex on either side.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <bodice/io/scene.hpp>

namespace bodice::inline v0_1::io {

/// The attribute of a GLB's vertices that holds the number of the cloth's vertex.
inline constexpr const char* kClothVertex = "_CLOTH_VERTEX";

/// The triangles of one material.
struct LookPart {
  std::uint32_t material = 0;  ///< into the look's materials, or kNoMaterial
  std::vector<geometry::Triangle> triangles;
};

/// Vertices by material, then by the cloth's vertex: two materials share none.
struct LookMesh {
  std::vector<geometry::Index> cloth_vertex;  ///< #V: the cloth's vertex that each one is
  std::vector<std::vector<float>> uv;         ///< a set each, #V x 2
  std::vector<LookPart> parts;

  /// The elements of an array over the cloth's vertices for the vertices here.
  template <class T>
  std::vector<T> spread(const std::vector<T>& of_cloth) const {
    std::vector<T> out;
    out.reserve(cloth_vertex.size());
    for (const geometry::Index v : cloth_vertex) out.push_back(of_cloth[v]);
    return out;
  }
  /// Whether the vertices are the cloth's own, in their order.
  bool is_cloth(std::size_t vertices) const;
};

/// Empty where the garment has no look, or shows a map of colors instead of it. O(#F log #F).
std::optional<LookMesh> look_mesh(const GarmentTrack& track);

}  // namespace bodice::io
