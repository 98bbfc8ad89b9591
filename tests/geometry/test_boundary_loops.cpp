#include <doctest/doctest.h>

#include <bodice/geometry/mesh_edges.hpp>
#include <bodice_test/shapes.hpp>

using namespace bodice::geometry;
using namespace bodice_test;

TEST_CASE("Euler's number counts the handles, the components and the holes") {
  auto euler = [](const TriMesh& mesh) { return euler_characteristic(mesh, mesh_edges(mesh)); };
  CHECK(euler(icosphere(1.0, 2)) == 2);
  CHECK(euler(box({1, 1, 1}, 4)) == 2);
  CHECK(euler(torus(1.0, 0.3, 20, 10)) == 0);
  CHECK(euler(cylinder(1.0, 2.0, 12, 3)) == 2);
  CHECK(euler(cylinder(1.0, 2.0, 12, 3, false)) == 0);
  CHECK(euler(sheet(1.0, 1.0, 3, 3)) == 1);
  CHECK(euler(joined(icosphere(1.0, 1), torus(1.0, 0.3, 20, 10))) == 2);
}

TEST_CASE("boundary loops are the rims, along the winding") {
  const TriMesh open = cylinder(1.0, 2.0, 12, 3, false);
  const auto loops = boundary_loops(open, mesh_edges(open));
  REQUIRE(loops.size() == 2);
  CHECK(loops[0].size() == 12);
  CHECK(loops[1].size() == 12);
  CHECK(loops[0].front() == 0);
  const TriMesh flat = sheet(1.0, 1.0, 3, 2);
  const auto rim = boundary_loops(flat, mesh_edges(flat));
  REQUIRE(rim.size() == 1);
  CHECK(rim[0].size() == 10);
  const TriMesh closed = icosphere(1.0, 2);
  CHECK(boundary_loops(closed, mesh_edges(closed)).empty());
}
