#include <doctest/doctest.h>

#include <bodice/geometry/mesh_edges.hpp>

#include "shapes.hpp"

using namespace bodice;

TEST_CASE("edges of a closed surface satisfy Euler's formula and know both triangles") {
  const auto mesh = shapes::sphere(3);
  const auto edges = geometry::mesh_edges(mesh);
  CHECK(mesh.positions.size() + mesh.triangles.size() == edges.ends.size() + 2);
  CHECK(edges.boundary == 0);
  CHECK(edges.non_manifold == 0);
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
    for (int k = 0; k < 3; ++k) {
      const auto e = edges.of_triangle[f][k];
      const auto [low, high] = std::minmax(mesh.triangles[f][k], mesh.triangles[f][(k + 1) % 3]);
      REQUIRE(edges.ends[e] == geometry::MeshEdges::Ends{low, high});
      REQUIRE((edges.triangles[e][0] == f || edges.triangles[e][1] == f));
    }
}

TEST_CASE("boundary edges have one triangle") {
  const auto edges = geometry::mesh_edges(shapes::grid(4));
  CHECK(edges.boundary == 16);
}

TEST_CASE("an edge of three triangles is counted, and keeps its first two") {
  geometry::TriMesh fin;
  fin.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}};
  fin.triangles = {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}};
  const auto edges = geometry::mesh_edges(fin);
  CHECK(edges.non_manifold == 1);
  CHECK(edges.triangles[edges.of_triangle[2][0]] == std::array<geometry::Index, 2>{0, 1});
}

TEST_CASE("no triangle, no edge") {
  CHECK(geometry::mesh_edges({}).ends.empty());
  geometry::TriMesh points;
  points.positions.assign(3, geometry::Vec3::Zero());
  CHECK(geometry::mesh_edges(points).ends.empty());
}
