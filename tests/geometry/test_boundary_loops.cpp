#include <doctest/doctest.h>

#include <algorithm>
#include <set>

#include <bodice/geometry/adjacency.hpp>
#include <bodice_test/extremes.hpp>
#include <bodice_test/shapes.hpp>

using namespace bodice::geometry;
using namespace bodice_test;

TEST_CASE("Euler's number counts the handles, the components and the holes") {
  auto euler = [](const TriMesh& mesh) { return euler_characteristic(mesh, build_adjacency(mesh)); };
  CHECK(euler(icosphere(1.0, 2)) == 2);
  CHECK(euler(box({1, 1, 1}, 4)) == 2);
  CHECK(euler(torus(1.0, 0.3, 20, 10)) == 0);
  CHECK(euler(cylinder(1.0, 2.0, 12, 3)) == 2);
  CHECK(euler(cylinder(1.0, 2.0, 12, 3, false)) == 0);
  CHECK(euler(sheet(1.0, 1.0, 3, 3)) == 1);
  CHECK(euler(joined(icosphere(1.0, 1), torus(1.0, 0.3, 20, 10))) == 2);
}

TEST_CASE("edges and neighbors agree with a brute-force search") {
  const TriMesh mesh = shuffled(joined(torus(1.0, 0.3, 12, 7), sheet(1.0, 1.0, 4, 3)), 5);
  const Adjacency adjacency = build_adjacency(mesh);
  std::set<std::array<Index, 2>> expected;
  for (const Triangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(t[k], t[(k + 1) % 3]);
      expected.insert({low, high});
    }
  REQUIRE(adjacency.edges.size() == expected.size());
  auto at = expected.begin();
  for (const Edge& edge : adjacency.edges) {
    CHECK(edge.vertex == *at++);
    std::vector<Index> holders;
    for (Index t = 0; t < mesh.triangles.size(); ++t) {
      const Triangle& corners = mesh.triangles[t];
      auto has = [&](Index v) { return std::find(corners.begin(), corners.end(), v) != corners.end(); };
      if (has(edge.vertex[0]) && has(edge.vertex[1])) holders.push_back(t);
    }
    REQUIRE(edge.triangle_count == holders.size());
    for (std::size_t i = 0; i < holders.size() && i < 2; ++i) CHECK(edge.triangle[i] == holders[i]);
  }
  for (Index v = 0; v < mesh.positions.size(); ++v)
    for (Index t : adjacency.triangles_around(v))
      CHECK(std::count(mesh.triangles[t].begin(), mesh.triangles[t].end(), v) == 1);
  for (Index t = 0; t < mesh.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const Index other = adjacency.across(t, k);
      if (other == kNoIndex) continue;
      CHECK(other != t);
      CHECK(std::count(mesh.triangles[other].begin(), mesh.triangles[other].end(), mesh.triangles[t][k]) ==
            1);
    }
}

TEST_CASE("boundary loops are the rims, along the winding") {
  const TriMesh open = cylinder(1.0, 2.0, 12, 3, false);
  const auto loops = boundary_loops(open, build_adjacency(open));
  REQUIRE(loops.size() == 2);
  CHECK(loops[0].size() == 12);
  CHECK(loops[1].size() == 12);
  CHECK(loops[0].front() == 0);
  const TriMesh flat = sheet(1.0, 1.0, 3, 2);
  const auto rim = boundary_loops(flat, build_adjacency(flat));
  REQUIRE(rim.size() == 1);
  CHECK(rim[0].size() == 10);
  const TriMesh closed = icosphere(1.0, 2);
  CHECK(boundary_loops(closed, build_adjacency(closed)).empty());
}

TEST_CASE("adjacency holds on every hostile mesh with valid indices") {
  for (const MeshCase& extreme : extreme_meshes()) {
    CAPTURE(extreme.name);
    const auto& mesh = extreme.mesh;
    const bool valid = std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const Triangle& t) {
      return *std::max_element(t.begin(), t.end()) < mesh.positions.size();
    });
    if (!valid) continue;
    const Adjacency adjacency = build_adjacency(mesh);
    std::size_t sides = 0;
    for (const Edge& edge : adjacency.edges) sides += edge.triangle_count;
    std::size_t expected = 0;
    for (const Triangle& t : mesh.triangles)
      for (int k = 0; k < 3; ++k) expected += t[k] != t[(k + 1) % 3];
    CHECK(sides == expected);
    std::size_t rim = 0;
    for (const auto& loop : boundary_loops(mesh, adjacency)) rim += loop.size();
    CHECK(rim == static_cast<std::size_t>(std::count_if(adjacency.edges.begin(), adjacency.edges.end(),
                                                        [](const Edge& e) { return e.boundary(); })));
  }
}
