#include "import/body/piece.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <bodice/geometry/mesh_edges.hpp>
#include <bodice/geometry/mesh_repair.hpp>

namespace bodice::inline v0_1::io {

namespace {

using geometry::Index;
using geometry::Vec3;

void add_boundaries(const JoinedScene& joined, const geometry::Components& components,
                    std::vector<Piece>& pieces) {
  if (joined.repaired.report.boundary_edges == 0) return;
  const geometry::MeshEdges edges = geometry::mesh_edges(joined.mesh);
  for (std::size_t e = 0; e < edges.ends.size(); ++e) {
    if (edges.triangle_count[e] != 1) continue;
    const auto [a, b] = edges.ends[e];
    pieces[components.of_vertex[a]].boundary_length +=
        (joined.mesh.positions[a] - joined.mesh.positions[b]).norm();
  }
}

/// Undoes the orientation of a repair: pieces are judged as they are in the file.
void wind_as_given(const FileScene& scene, JoinedScene& joined) {
  if (joined.repaired.report.flipped_triangles == 0) return;
  const std::vector<geometry::Triangle>& given = scene.meshes.front().shape.triangles;
  for (std::size_t t = 0; t < given.size(); ++t)
    if (const Index kept = joined.repaired.triangle_of_input[t]; kept != geometry::kNoIndex)
      for (std::size_t k = 0; k < 3; ++k)
        joined.mesh.triangles[kept][k] = joined.repaired.vertex_of_input[given[t][k]];
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
  const bool alone = scene.meshes.size() == 1;  // needs no copy
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
    if (!alone) append(scene.meshes[m].shape, all);
    source.resize(source.size() + scene.meshes[m].shape.triangles.size(), m);
  }
  auto repaired = geometry::repair(context, alone ? scene.meshes.front().shape : all, {.orient = alone});
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
  joined.repaired = std::move(*repaired);
  if (joined.repaired.report.components > 1) wind_as_given(scene, joined);
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
