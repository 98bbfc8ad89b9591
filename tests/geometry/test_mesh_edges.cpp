#include <doctest/doctest.h>

#include <algorithm>
#include <set>

#include <bodice/geometry/mesh_edges.hpp>
#include <bodice_test/extremes.hpp>
#include <bodice_test/shapes.hpp>

using namespace bodice::geometry;
using namespace bodice_test;

TEST_CASE("edges of a closed surface satisfy Euler's formula and list both triangles") {
  const auto mesh = icosphere(1.0, 3);
  const auto edges = mesh_edges(mesh);
  CHECK(mesh.positions.size() + mesh.triangles.size() == edges.ends.size() + 2);
  CHECK(edges.boundary == 0);
  CHECK(edges.non_manifold == 0);
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
    for (int k = 0; k < 3; ++k) {
      const auto e = edges.of_triangle[f][k];
      const auto [low, high] = std::minmax(mesh.triangles[f][k], mesh.triangles[f][(k + 1) % 3]);
      REQUIRE(edges.ends[e] == MeshEdges::Ends{low, high});
      REQUIRE((edges.triangles[e][0] == f || edges.triangles[e][1] == f));
    }
}

TEST_CASE("boundary edges have one triangle") {
  const auto edges = mesh_edges(sheet(1.0, 1.0, 4, 4));
  CHECK(edges.boundary == 16);
}

TEST_CASE("an edge of three triangles is counted, and keeps its first two") {
  TriMesh fin;
  fin.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}};
  fin.triangles = {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}};
  const auto edges = mesh_edges(fin);
  CHECK(edges.non_manifold == 1);
  CHECK(edges.triangles[edges.of_triangle[2][0]] == std::array<Index, 2>{0, 1});
}

TEST_CASE("a mesh without triangles has no edges") {
  CHECK(mesh_edges({}).ends.empty());
  TriMesh points;
  points.positions.assign(3, Vec3::Zero());
  CHECK(mesh_edges(points).ends.empty());
}

TEST_CASE("edges and neighbors agree with a brute-force search") {
  const TriMesh mesh = shuffled(joined(torus(1.0, 0.3, 12, 7), sheet(1.0, 1.0, 4, 3)), 5);
  const MeshEdges edges = mesh_edges(mesh);
  std::set<MeshEdges::Ends> expected;
  for (const Triangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(t[k], t[(k + 1) % 3]);
      expected.insert({low, high});
    }
  REQUIRE(edges.ends.size() == expected.size());
  auto at = expected.begin();
  for (Index e = 0; e < edges.ends.size(); ++e) {
    CHECK(edges.ends[e] == *at++);
    std::vector<Index> holders;
    for (Index t = 0; t < mesh.triangles.size(); ++t) {
      const Triangle& corners = mesh.triangles[t];
      auto has = [&](Index v) { return std::find(corners.begin(), corners.end(), v) != corners.end(); };
      if (has(edges.ends[e][0]) && has(edges.ends[e][1])) holders.push_back(t);
    }
    REQUIRE(edges.triangle_count[e] == holders.size());
    for (std::size_t i = 0; i < holders.size() && i < 2; ++i) CHECK(edges.triangles[e][i] == holders[i]);
  }
  for (Index t = 0; t < mesh.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const Index other = edges.across(t, k);
      if (other == kNoIndex) continue;
      CHECK(other != t);
      CHECK(std::count(mesh.triangles[other].begin(), mesh.triangles[other].end(), mesh.triangles[t][k]) ==
            1);
    }
}

TEST_CASE("edges hold on every hostile mesh with valid indices") {
  for (const MeshCase& extreme : extreme_meshes()) {
    CAPTURE(extreme.name);
    const auto& mesh = extreme.mesh;
    const bool valid = std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const Triangle& t) {
      return *std::max_element(t.begin(), t.end()) < mesh.positions.size();
    });
    if (!valid) continue;
    const MeshEdges edges = mesh_edges(mesh);
    std::size_t sides = 0;
    std::size_t open = 0;
    for (Index e = 0; e < edges.ends.size(); ++e) {
      if (edges.is_loop(e)) continue;
      sides += edges.triangle_count[e];
      open += edges.triangle_count[e] == 1;
    }
    std::size_t expected = 0;
    for (const Triangle& t : mesh.triangles)
      for (int k = 0; k < 3; ++k) expected += t[k] != t[(k + 1) % 3];
    CHECK(sides == expected);
    std::size_t rim = 0;
    for (const auto& loop : boundary_loops(mesh, edges)) rim += loop.size();
    CHECK(rim == open);
  }
}
