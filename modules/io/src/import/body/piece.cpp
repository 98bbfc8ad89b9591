#include "import/body/piece.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <bodice/geometry/mesh_repair.hpp>

namespace bodice::inline v0_1::io {

namespace {

using geometry::Index;
using geometry::Vec3;
using Edge = std::pair<Index, Index>;

std::vector<Edge> edges_of(const geometry::TriMesh& mesh) {
  std::vector<Edge> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (const geometry::Triangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) edges.push_back(std::minmax(t[k], t[(k + 1) % 3]));
  std::sort(edges.begin(), edges.end());
  return edges;
}

void add_boundaries(const JoinedScene& joined, const geometry::Components& components,
                    std::vector<Piece>& pieces) {
  const std::vector<Edge> edges = edges_of(joined.mesh);
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t end = i + 1;
    while (end < edges.size() && edges[end] == edges[i]) ++end;
    const auto [a, b] = edges[i];
    if (end == i + 1)
      pieces[components.of_vertex[a]].boundary_length +=
          (joined.mesh.positions[a] - joined.mesh.positions[b]).norm();
    i = end;
  }
}

}  // namespace

double Piece::openness() const {
  return area > 0.0 ? boundary_length / std::sqrt(area) : 0.0;
}

std::size_t Piece::main_source() const {
  const auto largest = std::max_element(area_of_source.begin(), area_of_source.end(),
                                        [](const auto& a, const auto& b) { return a.second < b.second; });
  return largest == area_of_source.end() ? 0 : largest->first;
}

engine::Result<JoinedScene> join(const engine::Context& context, const FileScene& scene) {
  geometry::TriMesh all;
  std::vector<std::size_t> source;
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
    append(scene.meshes[m].shape, all);
    source.resize(all.triangles.size(), m);
  }
  auto repaired = geometry::repair(context, all, {.orient = false});
  if (!repaired) return repaired.error();
  JoinedScene joined;
  joined.mesh = std::move(repaired->mesh);
  joined.source.resize(joined.mesh.triangles.size());
  for (std::size_t t = 0; t < source.size(); ++t)
    if (const Index kept = repaired->triangle_of_input[t]; kept != geometry::kNoIndex)
      joined.source[kept] = source[t];
  auto next = repaired->vertex_of_input.cbegin();
  for (const FileMesh& mesh : scene.meshes) {
    const auto end = next + static_cast<std::ptrdiff_t>(mesh.shape.positions.size());
    joined.vertex_of.emplace_back(next, end);
    next = end;
  }
  return joined;
}

std::vector<Piece> split(const JoinedScene& joined) {
  const geometry::Components components = geometry::connected_components(joined.mesh);
  std::vector<Piece> pieces(components.area.size());
  for (std::size_t t = 0; t < joined.mesh.triangles.size(); ++t) {
    Piece& piece = pieces[components.of_vertex[joined.mesh.triangles[t][0]]];
    const double area = 0.5 * area_vector(joined.mesh, t).norm();
    piece.triangles.push_back(static_cast<Index>(t));
    piece.area += area;
    piece.area_of_source[joined.source[t]] += area;
    for (int k = 0; k < 3; ++k) piece.box.extend(joined.mesh.corner(t, k));
  }
  for (Piece& piece : pieces) {
    const Vec3 center = piece.box.center();
    for (const Index t : piece.triangles) {
      const Vec3 a = joined.mesh.corner(t, 0) - center, b = joined.mesh.corner(t, 1) - center,
                 c = joined.mesh.corner(t, 2) - center;
      piece.volume += a.dot(b.cross(c)) / 6.0;
    }
    piece.volume = std::abs(piece.volume);
  }
  add_boundaries(joined, components, pieces);
  std::erase_if(pieces, [](const Piece& piece) { return piece.triangles.empty(); });
  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const Piece& a, const Piece& b) { return a.area > b.area; });
  return pieces;
}

}  // namespace bodice::io
