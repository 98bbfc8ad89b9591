#include <doctest/doctest.h>

#include <bodice/io/import.hpp>
#include <bodice_test/shapes.hpp>
#include <bodice_test/temp_folder.hpp>

#include "figure.hpp"

using namespace bodice;
using namespace io_test;
using bodice_test::TempFolder;

namespace {}

TEST_CASE("a garment is all its meshes together, in the body's frame, as it was wound") {
  const TempFolder folder;
  const TriMesh skirt = bodice_test::cylinder(30.0, 80.0, 24, 6, false);
  const TriMesh bodice_piece = mapped(bodice_test::cylinder(28.0, 40.0, 24, 6, false),
                                      [](const Vec3& p) { return Vec3(p + Vec3(0.0, 60.0, 0.0)); });
  auto inward = bodice_piece;
  for (auto& t : inward.triangles) std::swap(t[0], t[1]);
  const auto result =
      io::import_garment(kContext, folder.write("dress.obj", to_obj({{"skirt", skirt}, {"top", inward}})),
                         {.meters_per_unit = 0.01, .up = geometry::Axis::kZ});
  REQUIRE(result.ok());
  CHECK(result->skin.triangles.size() == skirt.triangles.size() + inward.triangles.size());
  CHECK(result->repair.flipped_triangles == 0);
  CHECK(result->frame.meters_per_unit == 0.01);
  const TriMesh truth = mapped(bodice_test::joined(skirt, inward),
                               [](const Vec3& p) { return Vec3(0.01 * Vec3(p.x(), p.z(), -p.y())); });
  CHECK(vertex_distance(result->skin, truth) < 1e-6);
}

TEST_CASE("pieces that only nearly touch stay apart; copies of a vertex do not") {
  const TempFolder folder;
  const TriMesh sheet = bodice_test::sheet(1.0, 1.0, 4, 4);
  const TriMesh beside = mapped(sheet, [](const Vec3& p) { return Vec3(p + Vec3(1.0 + 1e-5, 0.0, 0.0)); });
  const auto apart = io::import_garment(
      kContext, folder.write("a.stl", to_stl(bodice_test::joined(sheet, beside), true)), {});
  REQUIRE(apart.ok());
  CHECK(apart->repair.components == 2);
  CHECK(apart->skin.positions.size() == 2 * sheet.positions.size());
}

TEST_CASE("a pocket's flap, a third triangle at two edges, is kept") {
  const TempFolder folder;
  TriMesh can = bodice_test::cylinder(1.0, 2.0, 24, 6, true);
  const geometry::Triangle under = can.triangles[can.triangles.size() / 2];
  const auto tip = static_cast<geometry::Index>(can.positions.size());
  can.positions.push_back(1.3 * can.positions[under[0]]);
  can.triangles.push_back({under[0], under[1], tip});
  const auto result = io::import_garment(kContext, folder.write("pocket.obj", to_obj({{"can", can}})), {});
  REQUIRE(result.ok());
  CHECK(result->skin.triangles.size() == can.triangles.size());
}
