#include <doctest/doctest.h>

#include <bodice/geometry/mesh_edges.hpp>
#include <bodice/geometry/rebuild.hpp>
#include <bodice_test/shapes.hpp>

using namespace bodice::geometry;

TEST_CASE("sheets on each other are rebuilt as a closed surface near them, wherever they wind around") {
  TriMesh sheets = bodice_test::sheet(1.0, 2.0, 4, 8);
  for (int more = 0; more < 2; ++more)
    sheets = bodice_test::joined(sheets, bodice_test::sheet(1.0, 2.0, 4, 8));
  for (Vec3& p : sheets.positions) p.y() = 0.1 * p.x() * p.x();
  const double cell_m = 1.0 / 24.0;
  const RebuiltSurface rebuilt = rebuild({}, sheets, cell_m);
  REQUIRE_FALSE(rebuilt.mesh.empty());
  CHECK(mesh_edges(rebuilt.mesh).boundary == 0);
  const Box box = bounding_box(sheets.positions), found = bounding_box(rebuilt.mesh.positions);
  CHECK((found.low - box.low).minCoeff() > -3.0 * cell_m);
  CHECK((found.high - box.high).maxCoeff() < 3.0 * cell_m);
}

TEST_CASE("a sphere with holes is rebuilt closed, with the volume of the ball") {
  TriMesh sphere = bodice_test::icosphere(1.0, 4);
  std::erase_if(sphere.triangles, [&](const Triangle& t) {
    return sphere.positions[t[0]].y() > 0.93 || sphere.positions[t[0]].x() > 0.96;
  });
  const RebuiltSurface rebuilt = rebuild({}, sphere, 0.05);
  CHECK(mesh_edges(rebuilt.mesh).boundary == 0);
  CHECK(signed_volume(rebuilt.mesh) == doctest::Approx(4.18879).epsilon(0.03));
  CHECK(rebuilt.measured_share > 0.85);
  CHECK(rebuilt.measured_share < 0.99);
}
