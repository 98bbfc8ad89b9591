#include <doctest/doctest.h>

#include <bodice/io/import.hpp>
#include <bodice_test/shapes.hpp>
#include <bodice_test/temp_folder.hpp>

#include "figure.hpp"

using namespace bodice;
using namespace io_test;
using bodice_test::TempFolder;

namespace {

bool has_code(const io::ImportedMesh& read, std::string_view code) {
  for (const engine::Warning& warning : read.warnings)
    if (warning.code == code) return true;
  return false;
}

/// A can of 40 by 60, the size of a stool in centimeters.
TriMesh can() {
  return bodice_test::cylinder(20.0, 60.0, 24, 6, true);
}

double height_m(const io::ImportedMesh& read) {
  return geometry::bounding_box(read.skin.positions).size().y();
}

}  // namespace

TEST_CASE("a thing's unit is the given one, else the file's, else meters with a warning") {
  const TempFolder folder;
  const auto file = folder.write("can.obj", to_obj({{"can", can()}}));
  const auto assumed = io::import_body(kContext, file, {.shape = io::Shape::kAny});
  REQUIRE_MESSAGE(assumed.ok(), assumed.error().sentence());
  CHECK(height_m(*assumed) == doctest::Approx(60.0));
  CHECK(assumed->unit == "m");
  CHECK(has_code(*assumed, "unit-assumed"));
  CHECK(assumed->shape == io::Shape::kAny);

  const auto given =
      io::import_body(kContext, file, {.shape = io::Shape::kAny, .unit = io::Unit::kCentimeter});
  REQUIRE(given.ok());
  CHECK(height_m(*given) == doctest::Approx(0.6));
  CHECK(given->unit == "cm");
  CHECK(given->warnings.empty());

  const geometry::Frame other{.meters_per_unit = 0.001, .up = geometry::Axis::kZ};
  const auto framed = io::import_body(kContext, file, {.shape = io::Shape::kAny, .frame = other});
  REQUIRE(framed.ok());
  CHECK(framed->frame.up == geometry::Axis::kZ);
  CHECK(geometry::bounding_box(framed->skin.positions).size().z() == doctest::Approx(0.06));
  CHECK(framed->warnings.empty());
}

TEST_CASE("a thing is all meshes of its file, or those of a name; up is y unless it is given") {
  const TempFolder folder;
  const TriMesh lid = mapped(can(), [](const Vec3& p) { return Vec3(0.1 * p + Vec3(0.0, 50.0, 0.0)); });
  const auto file = folder.write("two.obj", to_obj({{"can", can()}, {"lid", lid}}));
  const auto all = io::import_body(kContext, file, {.shape = io::Shape::kAny});
  REQUIRE(all.ok());
  CHECK(all->skin.triangles.size() == can().triangles.size() + lid.triangles.size());
  CHECK(all->repair.components == 2);
  CHECK(all->frame.up == geometry::Axis::kY);
  CHECK_FALSE(has_code(*all, "pieces-left-out"));
  const auto one = io::import_body(kContext, file, {.shape = io::Shape::kAny, .mesh = "lid"});
  REQUIRE(one.ok());
  CHECK(one->skin.triangles.size() == lid.triangles.size());
  CHECK_FALSE(io::import_body(kContext, file, {.shape = io::Shape::kAny, .mesh = "leg"}).ok());
  const auto lying =
      io::import_body(kContext, file, {.shape = io::Shape::kAny, .up = geometry::Axis::kX, .mesh = "can"});
  REQUIRE(lying.ok());
  CHECK(height_m(*lying) == doctest::Approx(40.0).epsilon(0.01));
}
