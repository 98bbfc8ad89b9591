#include <bodice/geodesic/distance_solver.hpp>

#include "fast_marching.hpp"

namespace bodice::inline v0_1::geodesic {

DistanceSolver::DistanceSolver(const engine::Context& context, const geometry::TriMesh& mesh,
                               const geometry::MeshEdges& edges, Method method)
    : mesh_(mesh), edges_(edges), method_(method) {
  if (method == Method::kFastMarching)
    around_ = edges_of_vertex(mesh.positions.size(), edges);
  else
    graph_ = edge_graph(context, mesh, edges, method == Method::kEdges ? Metric::kEdges : Metric::kUnfolded);
}

Field DistanceSolver::distances(std::span<const Seed> seeds) const {
  if (method_ == Method::kFastMarching) return fast_marching(mesh_, edges_, around_, seeds);
  return geodesic::distances(graph_, seeds);
}

Field DistanceSolver::distances_from(geometry::Index source) const {
  const Seed seed{source, 0.0F};
  return distances({&seed, 1});
}

}  // namespace bodice::geodesic
