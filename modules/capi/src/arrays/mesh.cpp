#include "arrays/mesh.hpp"

#include <cstdint>

#include "arrays/strided.hpp"
#include "base/handles.hpp"
#include "base/structures.hpp"

namespace bodice::inline v0_1::capi {
namespace {

/// The i-th index; those of 2 and 4 bytes widen.
std::uint64_t index_at(const Strided& numbers, std::int32_t bytes, std::size_t i) {
  if (bytes == 2) return numbers.get<std::uint16_t>(i);
  return bytes == 4 ? numbers.get<std::uint32_t>(i) : numbers.get<std::uint64_t>(i);
}

Outcome check(const bodice_mesh& mesh) {
  if (mesh.vertices > BODICE_MAX_PARTICLES || mesh.triangles > BODICE_MAX_PARTICLES)
    return invalid("The mesh has " + std::to_string(mesh.vertices) + " vertices and " +
                       std::to_string(mesh.triangles) + " triangles.",
                   "Pass at most BODICE_MAX_PARTICLES of either.");
  if (mesh.index_bytes != 2 && mesh.index_bytes != 4 && mesh.index_bytes != 8)
    return invalid("bodice_mesh.index_bytes is " + std::to_string(mesh.index_bytes) + ".", "Give 2, 4 or 8.");
  if (mesh.vertices == 0 || mesh.triangles == 0 || !mesh.index)
    return invalid("The mesh has no vertices or no triangles.",
                   "Set vertices, triangles, position and index.");
  return {};
}

}  // namespace

Outcome read_mesh(const bodice_mesh* given, geometry::TriMesh& out) {
  bodice_mesh mesh;
  BODICE_CHECK(read(given, mesh));
  BODICE_CHECK(check(mesh));
  StridedVectors positions;
  BODICE_CHECK(read_vectors(mesh.position, mesh.vertices, "bodice_mesh.position", positions));
  if (!positions) return invalid("bodice_mesh.position has no arrays.", "Set position.x, or x, y and z.");
  Strided numbers;
  BODICE_CHECK(read_elements(const_cast<void*>(mesh.index), 0, static_cast<std::size_t>(mesh.index_bytes),
                             3 * mesh.triangles, "bodice_mesh.index", numbers));
  out.positions.resize(mesh.vertices);
  for (std::size_t v = 0; v < mesh.vertices; ++v) {
    double xyz[3];
    positions.get(v, xyz);
    out.positions[v] = {xyz[0], xyz[1], xyz[2]};
    if (!out.positions[v].allFinite())
      return invalid("Vertex " + std::to_string(v) + " of the mesh is not finite.", "Remove or mend it.");
  }
  out.triangles.resize(mesh.triangles);
  for (std::size_t i = 0; i < 3 * mesh.triangles; ++i) {
    const std::uint64_t vertex = index_at(numbers, mesh.index_bytes, i);
    if (vertex >= mesh.vertices)
      return invalid("Triangle " + std::to_string(i / 3) + " refers to vertex " + std::to_string(vertex) +
                         ", and there are " + std::to_string(mesh.vertices) + ".",
                     "Check the index and index_bytes.");
    out.triangles[i / 3][i % 3] = static_cast<geometry::Index>(vertex);
  }
  return {};
}

}  // namespace bodice::capi
