#include "look/look_mesh.hpp"

#include <algorithm>
#include <numeric>

#include "look/look.hpp"

namespace bodice::inline v0_1::io {

namespace {

using geometry::Index;

/// Corners of triangles by number, three a triangle.
class Corners {
 public:
  Corners(const geometry::TriMesh& mesh, const Look& look) : mesh_(mesh), look_(look) {}

  Index vertex(std::size_t corner) const { return mesh_.triangles[corner / 3][corner % 3]; }
  /// All texture coordinates of a corner, set after set.
  std::span<const float> uv(std::size_t corner) const {
    const std::size_t width = 2 * look_.uv_sets;
    return std::span(look_.uv).subspan(corner * width, width);
  }
  bool before(std::size_t a, std::size_t b) const {
    if (vertex(a) != vertex(b)) return vertex(a) < vertex(b);
    return std::ranges::lexicographical_compare(uv(a), uv(b));
  }

 private:
  const geometry::TriMesh& mesh_;
  const Look& look_;
};

/// Adds the triangles of one material, with vertices of their own.
void add_part(const Corners& corners, std::uint32_t material, std::vector<std::size_t> own, LookMesh& out) {
  const std::vector<std::size_t> in_order = own;
  std::ranges::stable_sort(own, [&](std::size_t a, std::size_t b) { return corners.before(a, b); });
  std::vector<std::pair<std::size_t, Index>> vertex_of;  // by corner
  vertex_of.reserve(own.size());
  for (std::size_t i = 0; i < own.size(); ++i) {
    if (i == 0 || corners.before(own[i - 1], own[i])) {
      out.cloth_vertex.push_back(corners.vertex(own[i]));
      for (std::size_t set = 0; set < out.uv.size(); ++set)
        for (std::size_t k = 0; k < 2; ++k) out.uv[set].push_back(corners.uv(own[i])[2 * set + k]);
    }
    vertex_of.emplace_back(own[i], static_cast<Index>(out.cloth_vertex.size() - 1));
  }
  std::ranges::sort(vertex_of);  // by corner, as in_order, where triangles are whole
  LookPart& part = out.parts.emplace_back();
  part.material = material;
  for (std::size_t i = 0; i + 2 < in_order.size(); i += 3)
    part.triangles.push_back({vertex_of[i].second, vertex_of[i + 1].second, vertex_of[i + 2].second});
}

}  // namespace

bool LookMesh::is_cloth(std::size_t vertices) const {
  if (cloth_vertex.size() != vertices) return false;
  for (std::size_t v = 0; v < vertices; ++v)
    if (cloth_vertex[v] != v) return false;
  return true;
}

std::optional<LookMesh> look_mesh(const GarmentTrack& track) {
  if (!track.look || !track.colors.empty()) return std::nullopt;
  const Look& look = *track.look;
  const Corners corners(track.mesh, look);
  LookMesh out;
  out.uv.resize(look.uv_sets);
  std::vector<std::uint32_t> materials = look.material;
  std::ranges::sort(materials);
  materials.erase(std::unique(materials.begin(), materials.end()), materials.end());
  for (const std::uint32_t material : materials) {
    std::vector<std::size_t> own;
    for (std::size_t t = 0; t < look.material.size(); ++t)
      if (look.material[t] == material)
        for (std::size_t k = 0; k < 3; ++k) own.push_back(3 * t + k);
    add_part(corners, material, std::move(own), out);
  }
  return out;
}

}  // namespace bodice::io
