#include <algorithm>

#include <doctest/doctest.h>
#include <Eigen/Geometry>

#include <bodice/geometry/mesh_edges.hpp>
#include <bodice/geometry/mesh_repair.hpp>
#include <bodice/geometry/rebuild.hpp>
#include <bodice/geometry/smallest_turn.hpp>
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

TEST_CASE("parts that are thinner than a cell are rebuilt, and a floor that the body stands on is not") {
  const double cell_m = 0.05;
  // A finger of 0.4 cells of radius that comes out of the ball by 8 cells.
  TriMesh finger = bodice_test::cylinder(0.02, 0.5, 12, 40);
  const Vec3 out = Vec3(0.3, 0.4, 1.0).normalized();
  const Eigen::Quaterniond turn = smallest_turn(Vec3::UnitY(), out);
  for (Vec3& p : finger.positions) p = 1.15 * out + turn * p;
  TriMesh floor = bodice_test::sheet(6.0, 6.0, 60, 60);
  for (Vec3& p : floor.positions) p.y() -= 1.0;
  const TriMesh body = bodice_test::joined(bodice_test::icosphere(1.0, 4), finger);
  const RebuiltSurface rebuilt = rebuild({}, bodice_test::joined(body, floor), cell_m);
  CHECK(mesh_edges(rebuilt.mesh).boundary == 0);
  double reach = 0.0;
  for (const Vec3& p : rebuilt.mesh.positions) reach = std::max(reach, p.dot(out));
  CHECK(reach > 1.4 - cell_m);
  CHECK(reach < 1.4 + cell_m);
  CHECK(rebuilt.lost_share < 1e-4);
  const Box box = bounding_box(rebuilt.mesh.positions);
  CHECK(box.high.x() < 1.2);
  CHECK(box.low.x() > -1.2);
}

TEST_CASE("a card beside the body that is both sides of one sheet is not rebuilt") {
  TriMesh top = bodice_test::sheet(0.8, 0.8, 20, 20), bottom = top;
  for (Triangle& t : bottom.triangles) std::swap(t[1], t[2]);
  for (Vec3& p : top.positions) p.y() -= 1.2;
  for (Vec3& p : bottom.positions) p.y() -= 1.205;
  const TriMesh ball = bodice_test::icosphere(1.0, 4);
  const TriMesh with_card = bodice_test::joined(ball, bodice_test::joined(top, bottom));
  const RebuiltSurface alone = rebuild({}, ball, 0.05), rebuilt = rebuild({}, with_card, 0.05);
  CHECK(connected_components(rebuilt.mesh).area.size() == 1);
  CHECK(mesh_edges(rebuilt.mesh).boundary == 0);
  CHECK(rebuilt.measured.size() == rebuilt.mesh.positions.size());
  CHECK(signed_volume(rebuilt.mesh) == doctest::Approx(signed_volume(alone.mesh)).epsilon(0.01));
}

TEST_CASE("the end of a piece that is tucked into another one is covered, not lost") {
  TriMesh tucked = bodice_test::icosphere(0.3, 3);
  for (Vec3& p : tucked.positions) p.x() += 0.9;  // reaches .4 into the ball
  const RebuiltSurface rebuilt =
      rebuild({}, bodice_test::joined(bodice_test::icosphere(1.0, 4), tucked), 0.05);
  REQUIRE_FALSE(rebuilt.mesh.empty());
  CHECK(rebuilt.lost_share == 0.0);
}
