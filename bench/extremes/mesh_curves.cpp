#include <algorithm>
#include <cmath>

#include <bodice/engine/random.hpp>
#include <bodice/geodesic/distance_solver.hpp>
#include <bodice/geometry/mesh_distance.hpp>

#include "curve.hpp"

namespace extremes_bench {
namespace {

using namespace bodice;
using geometry::Index;
using geometry::TriMesh;
using geometry::Vec3;

constexpr int kMeshQueries = 1000, kCells = 16;

TriMesh box_at(const Placement& placement) {
  TriMesh mesh;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 u(corner & 1 ? 1.0 : -1.0, corner & 2 ? 1.0 : -1.0, corner & 4 ? 1.0 : -1.0);
    mesh.positions.push_back(placement.to_world(placement.extents_m().cwiseProduct(u)));
  }
  mesh.triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
  return mesh;
}

double box_distance(const Vec3& half, const Vec3& p) {
  const Vec3 over = p.cwiseAbs() - half;
  return over.cwiseMax(0.0).norm() + std::min(0.0, over.maxCoeff());
}

double mesh_distance_error(const Placement& placement) {
  const geometry::MeshDistance distance({}, box_at(placement));
  engine::Random random(3);
  double worst = 0.0;
  for (int i = 0; i < kMeshQueries; ++i) {
    Vec3 u;
    for (int axis = 0; axis < 3; ++axis) u[axis] = random.uniform(-1.5, 1.5);
    const Vec3 local =
        i % 2 == 0 ? placement.extents_m().cwiseProduct(u).eval() : Vec3(placement.scale_m * u);
    const double truth = box_distance(placement.extents_m(), local);
    worst = std::max(worst, std::abs(distance.signed_distance(placement.to_world(local)) - truth));
  }
  return worst / placement.scale_m;
}

/// The worst relative error on a flat rectangle, `aspect` times as wide as long, where geodesics are straight
/// lines.
double geodesic_error(const Placement& placement, geodesic::Method method) {
  TriMesh sheet;
  std::vector<double> truth;
  for (int j = 0; j <= kCells; ++j)
    for (int i = 0; i <= kCells; ++i) {
      const Vec3 local = placement.scale_m / kCells * Vec3(i, 0.0, j / placement.aspect);
      truth.push_back(local.norm());
      sheet.positions.push_back(placement.to_world(local));
    }
  for (Index j = 0; j < kCells; ++j)
    for (Index i = 0; i < kCells; ++i) {
      const Index a = j * (kCells + 1) + i, b = a + 1, c = a + kCells + 1, d = c + 1;
      sheet.triangles.push_back({a, c, b});
      sheet.triangles.push_back({b, c, d});
    }
  const auto edges = geometry::mesh_edges(sheet);
  const auto field = geodesic::DistanceSolver({}, sheet, edges, method).distances_from(0);
  double worst = 0.0;
  for (std::size_t v = 1; v < truth.size(); ++v)
    worst = std::max(worst, std::abs(static_cast<double>(field[v]) - truth[v]) / truth[v]);
  return worst;
}

}  // namespace

std::vector<Curve> mesh_curves() {
  using geodesic::Method;
  return {{"MeshDistance", "distance, to size", mesh_distance_error},
          {"geodesics, edges", "distance on a flat sheet, to itself",
           [](const Placement& p) { return geodesic_error(p, Method::kEdges); }},
          {"geodesics, unfolded", "distance on a flat sheet, to itself",
           [](const Placement& p) { return geodesic_error(p, Method::kUnfolded); }},
          {"geodesics, fast marching", "distance on a flat sheet, to itself",
           [](const Placement& p) { return geodesic_error(p, Method::kFastMarching); }}};
}

}  // namespace extremes_bench
