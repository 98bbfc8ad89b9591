#include "skin/skin.hpp"

#include <bodice/engine/parallel.hpp>
#include <bodice/geometry/mesh_repair.hpp>

namespace bodice::inline v0_1::anatomy {

namespace {

/// The genus of component 0 by the Euler characteristic, if its surface is closed.
int handles_of(const Skin& skin) {
  if (skin.edges.boundary > 0 || skin.edges.non_manifold > 0) return 0;
  long euler = 0;
  for (const geometry::Index c : skin.component) euler += c == 0;
  for (const auto& ends : skin.edges.ends) euler -= skin.component[ends[0]] == 0;
  for (const auto& t : skin.mesh.triangles) euler += skin.component[t[0]] == 0;
  return static_cast<int>((2 - euler) / 2);
}

}  // namespace

Skin make_skin(const engine::Context& context, const geometry::TriMesh& mesh) {
  Skin skin{.mesh = mesh, .edges = geometry::mesh_edges(mesh)};
  geometry::Components pieces;
  engine::parallel_for(context, 2, 1, [&](std::size_t task, std::size_t) {
    if (task == 0) skin.graph = geodesic::edge_graph(context, mesh, skin.edges, geodesic::Metric::kUnfolded);
    if (task == 1) pieces = geometry::connected_components(mesh);
  });
  skin.component = std::move(pieces.of_vertex);
  skin.components = pieces.area.size();
  for (const double area : pieces.area) skin.pieces += area > 0.0;
  skin.open_edges = skin.edges.boundary;
  skin.handles = handles_of(skin);
  return skin;
}

geometry::Vec3 normal_at_edge(const Skin& skin, geometry::Index edge) {
  return geometry::area_vector(skin.mesh, skin.edges.triangles[edge][0]);
}

float value_at(const Skin& skin, const SkinPoint& point, std::span<const float> field) {
  const auto [a, b] = skin.edges.ends[point.edge];
  const double from_a = (point.position - skin.mesh.positions[a]).norm();
  const double from_b = (point.position - skin.mesh.positions[b]).norm();
  const double length = from_a + from_b;
  const auto t = static_cast<float>(length > 0.0 ? from_a / length : 0.5);
  return (1.0F - t) * field[a] + t * field[b];
}

}  // namespace bodice::anatomy
