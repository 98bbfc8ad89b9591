#include "skin.hpp"

#include <bodice/geometry/mesh_repair.hpp>

namespace bodice::anatomy {

Skin make_skin(const engine::Context& context, const geometry::TriMesh& mesh) {
  Skin skin{mesh, geodesic::mesh_edges(mesh), {}, {}, 0};
  skin.graph = geodesic::edge_graph(context, mesh, skin.edges, geodesic::Metric::kUnfolded);
  geometry::Components pieces = geometry::connected_components(mesh);
  skin.component = std::move(pieces.of_vertex);
  skin.components = pieces.area.size();
  return skin;
}

geometry::Vec3 normal_at_edge(const Skin& skin, geometry::Index edge) {
  return geometry::area_vector(skin.mesh, skin.edges.triangles[edge][0]);
}

}  // namespace bodice::anatomy
