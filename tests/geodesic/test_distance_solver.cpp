#include <doctest/doctest.h>

#include <algorithm>

#include <bodice/engine/random.hpp>
#include <bodice/geodesic/distance_solver.hpp>

#include "shapes.hpp"

using namespace bodice;
using geodesic::DistanceSolver;
using geodesic::Method;

namespace {

geodesic::Field distances(const geometry::TriMesh& mesh, Method method, geometry::Index source) {
  const auto edges = geometry::mesh_edges(mesh);
  return DistanceSolver({}, mesh, edges, method).distances_from(source);
}

/// A flat square with displaced vertices: it has many obtuse triangles, and the true distance is the straight
/// line.
geometry::TriMesh crumpled_square() {
  auto mesh = shapes::grid(24);
  engine::Random random(9);
  for (auto& p : mesh.positions) {
    const bool border = p.x() < 1e-9 || p.y() < 1e-9 || p.x() > 1.0 - 1e-9 || p.y() > 1.0 - 1e-9;
    if (!border) p += geometry::Vec3(random.uniform(-0.016, 0.016), random.uniform(-0.016, 0.016), 0.0);
  }
  return mesh;
}

/// The mean and the worst relative error on the unit sphere, beyond a tenth of the half circle.
std::pair<double, double> sphere_error(Method method) {
  const auto mesh = shapes::sphere(5);
  const auto field = distances(mesh, method, 0);
  double sum = 0.0, worst = 0.0;
  int count = 0;
  for (std::size_t v = 0; v < field.size(); ++v) {
    const double truth = std::acos(std::clamp(mesh.positions[v].z(), -1.0, 1.0));
    if (truth < 0.3) continue;
    const double error = std::abs(static_cast<double>(field[v]) / truth - 1.0);
    sum += error;
    worst = std::max(worst, error);
    ++count;
  }
  return {sum / count, worst};
}

}  // namespace

TEST_CASE("fast marching on a flat square is the straight line, whatever the triangles") {
  const auto mesh = crumpled_square();
  for (const geometry::Index source : {geometry::Index{0}, geometry::Index{312}, geometry::Index{77}}) {
    const auto field = distances(mesh, Method::kFastMarching, source);
    for (std::size_t v = 0; v < field.size(); ++v) {
      const double truth = (mesh.positions[v] - mesh.positions[source]).norm();
      REQUIRE(std::abs(static_cast<double>(field[v]) - truth) < 0.01 * truth + 1e-6);
    }
  }
}

TEST_CASE("on a sphere each method is more accurate than the one before") {
  const auto edges = sphere_error(Method::kEdges), unfolded = sphere_error(Method::kUnfolded),
             marching = sphere_error(Method::kFastMarching);
  CHECK(unfolded.first < 0.5 * edges.first);
  CHECK(marching.first < 0.2 * unfolded.first);
  CHECK(marching.first < 0.003);
  CHECK(marching.second < 0.015);  // beside the corners of the octahedron, where four triangles meet
}

TEST_CASE("fast marching scales with the mesh and does not depend on its position") {
  const auto reference = distances(shapes::sphere(3), Method::kFastMarching, 7);
  for (const double scale : {1e-6, 1e-3, 1e3, 1e6}) {
    const geometry::Vec3 away = scale < 1.0 ? geometry::Vec3::Zero() : geometry::Vec3(1e4, -1e4, 1e4);
    const auto field = distances(shapes::sphere(3, scale, away), Method::kFastMarching, 7);
    for (std::size_t v = 0; v < field.size(); ++v)
      REQUIRE(static_cast<double>(field[v]) / scale ==
              doctest::Approx(static_cast<double>(reference[v])).epsilon(1e-5));
  }
}

TEST_CASE("several seeds give the nearest, and other pieces stay unreachable") {
  auto mesh = shapes::grid(12);
  const auto n = static_cast<geometry::Index>(mesh.positions.size());
  for (const auto& p : shapes::grid(2).positions) mesh.positions.push_back(p + geometry::Vec3(9, 0, 0));
  for (auto t : shapes::grid(2).triangles) mesh.triangles.push_back({t[0] + n, t[1] + n, t[2] + n});
  const auto edges = geometry::mesh_edges(mesh);
  const DistanceSolver solver({}, mesh, edges, Method::kFastMarching);
  const std::array<geodesic::Seed, 3> seeds{{{0, 0.0F}, {168, 0.25F}, {99999, 0.0F}}};
  const auto field = solver.distances(seeds);
  for (geometry::Index v = 0; v < n; ++v) {
    const double truth =
        std::min(mesh.positions[v].norm(), 0.25 + (mesh.positions[v] - mesh.positions[168]).norm());
    CHECK(static_cast<double>(field[v]) == doctest::Approx(truth).epsilon(0.03));
  }
  CHECK(field[n] == geodesic::kUnreachable);
}

TEST_CASE("degenerate meshes end without NaN") {
  geometry::TriMesh mesh;
  CHECK(distances(mesh, Method::kFastMarching, 0).empty());
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 0, 0}};
  mesh.triangles = {{0, 1, 2}, {1, 2, 3}, {2, 3, 3}};
  CHECK(distances(mesh, Method::kFastMarching, 0)[2] == doctest::Approx(2.0));
  mesh.positions[1] = {std::nan(""), 0, 0};
  for (const float d : distances(mesh, Method::kFastMarching, 0)) CHECK(!std::isnan(d));
}
