// Triangles with any indices between points of a small grid: repair, then the functions that take a repaired
// mesh; and the cloth's welding, which takes any mesh.
#include <cmath>
#include <limits>

#include <bodice/cloth/weld.hpp>
#include <bodice/geodesic/distance_solver.hpp>
#include <bodice/geodesic/isoline.hpp>
#include <bodice/geometry/mesh_distance.hpp>
#include <bodice/geometry/mesh_repair.hpp>

#include "harness.hpp"

using namespace bodice;
using geometry::Vec3;

namespace {

geometry::TriMesh mesh_of(fuzz::Bytes& in) {
  geometry::TriMesh mesh;
  const int vertices = in.next() % 32;
  for (int v = 0; v < vertices; ++v) {
    const int a = in.next(), b = in.next();
    Vec3 p(a & 7, (a >> 3) & 7, b & 7);
    if ((b & 0xF8) == 0xF8) p.x() = std::numeric_limits<double>::quiet_NaN();
    mesh.positions.push_back(p);
  }
  while (!in.rest().empty() && mesh.triangles.size() < 64)
    mesh.triangles.push_back({in.next() % 33u, in.next() % 33u, in.next() % 33u});
  return mesh;
}

void use_repaired(const geometry::TriMesh& mesh) {
  const auto edges = geometry::mesh_edges(mesh);
  for (const auto method :
       {geodesic::Method::kEdges, geodesic::Method::kUnfolded, geodesic::Method::kFastMarching}) {
    const geodesic::DistanceSolver solver({}, mesh, edges, method);
    const auto field = solver.distances_from(0);
    for (const float d : field) FUZZ_CHECK(d >= 0.0f);
    const float levels[] = {0.5f, 2.0f};
    for (const auto& level : geodesic::isolines(mesh, edges, field, levels))
      for (const auto& line : level) FUZZ_CHECK(std::isfinite(line.girth_m));
  }
  const geometry::MeshDistance distance({}, mesh);
  FUZZ_CHECK(std::abs(distance.signed_distance(mesh.corner(0, 0))) < 1e-9);
  FUZZ_CHECK(std::isfinite(distance.signed_distance(Vec3(3.1, 2.7, 4.4))));
}

}  // namespace

FUZZ_TARGET(mesh) {
  fuzz::Bytes in(data, size);
  const geometry::TriMesh mesh = mesh_of(in);
  const auto repaired = geometry::repair({}, mesh);
  fuzz::check_reported(repaired);
  if (repaired.ok()) use_repaired(repaired->mesh);
  const auto welded = cloth::weld(mesh);
  fuzz::check_reported(welded);
  if (welded.ok())
    for (const auto p : welded->particle_of_vertex)
      FUZZ_CHECK(p == geometry::kNoIndex || p < welded->mesh.positions.size());
  return 0;
}
