#include <doctest/doctest.h>

#include <bodice/io/import.hpp>
#include <bodice_test/temp_folder.hpp>

#include "figure.hpp"

using namespace bodice;
using namespace io_test;
using bodice_test::TempFolder;

namespace {

TriMesh import_sheet(const std::string& obj) {
  const TempFolder folder;
  auto result = io::import_garment({}, folder.write("a.obj", obj), {});
  REQUIRE(result.ok());
  return std::move(result->skin);
}

/// Checks that every triangle faces +z and that together they cover exactly this area.
void check_flat_cover(const TriMesh& mesh, double area, std::size_t triangles) {
  double sum = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    CHECK(area_vector(mesh, t).z() > 0.0);
    sum += 0.5 * area_vector(mesh, t).norm();
  }
  CHECK(sum == doctest::Approx(area));
  CHECK(mesh.triangles.size() == triangles);
}

}  // namespace

TEST_CASE("polygons become triangles that cover the same area, convex or not") {
  SUBCASE("square") {
    check_flat_cover(import_sheet("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n"), 1.0, 2);
  }
  SUBCASE("arrowhead, whichever corner comes first") {
    for (const char* face : {"f 1 2 3 4\n", "f 2 3 4 1\n", "f 3 4 1 2\n", "f 4 1 2 3\n"})
      check_flat_cover(import_sheet(std::string("v 0 0 0\nv 2 1 0\nv 0 2 0\nv 0.5 1 0\n") + face), 1.5, 2);
  }
  SUBCASE("an L of six corners") {
    check_flat_cover(import_sheet("v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nf 1 2 3 4 5 6\n"),
                     3.0, 4);
  }
  SUBCASE("a comb of twelve corners") {
    check_flat_cover(import_sheet("v 0 0 0\nv 5 0 0\nv 5 3 0\nv 4 3 0\nv 4 1 0\nv 3 1 0\nv 3 3 0\nv 2 3 0\n"
                                  "v 2 1 0\nv 1 1 0\nv 1 3 0\nv 0 3 0\nf 1 2 3 4 5 6 7 8 9 10 11 12\n"),
                     11.0, 10);
  }
}

TEST_CASE("a polygon that crosses itself still gives its count of triangles") {
  const TriMesh bow = import_sheet("v 0 0 0\nv 1 1 0\nv 1 0 0\nv 0 1 0\nf 1 2 3 4\n");
  CHECK(bow.triangles.size() == 2);
}
