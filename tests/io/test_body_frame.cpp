#include <doctest/doctest.h>

#include <array>

#include <bodice/engine/random.hpp>
#include <bodice/io/import.hpp>
#include <bodice_test/shapes.hpp>
#include <bodice_test/temp_folder.hpp>

#include "figure.hpp"

using namespace bodice;
using namespace io_test;
using bodice_test::TempFolder;

namespace {

io::ImportedMesh import_obj(const TriMesh& mesh, const io::ImportOptions& options = {}) {
  const TempFolder folder;
  auto result = io::import_body(kContext, folder.write("a.obj", to_obj({{"", mesh}})), options);
  REQUIRE(result.ok());
  return std::move(*result);
}

double height(const TriMesh& mesh) {
  return geometry::bounding_box(mesh.positions).size().y();
}

bool warned(const io::ImportedMesh& mesh, std::string_view code) {
  return std::any_of(mesh.warnings.begin(), mesh.warnings.end(),
                     [&](const engine::Warning& w) { return w.code == code; });
}

}  // namespace

TEST_CASE("the unit follows from the skin's area, for adults and children") {
  struct Case {
    const char* unit;
    double per_meter;
  };
  for (const auto& [unit, per_meter] :
       {Case{"m", 1.0}, Case{"dm", 10.0}, Case{"cm", 100.0}, Case{"mm", 1000.0}, Case{"inch", 1.0 / 0.0254}})
    for (const double stature : {0.9, 1.0, 1.1}) {
      if (std::string_view(unit) == "inch" && stature < 0.95) continue;  // an infant in centimeters
      CAPTURE(unit);
      CAPTURE(stature);
      const auto mesh =
          import_obj(mapped(figure(), [&](const Vec3& p) { return Vec3(stature * per_meter * p); }));
      CHECK(mesh.unit == unit);
      CHECK(height(mesh.skin) == doctest::Approx(1.7 * stature).epsilon(1e-3));
      CHECK(!warned(mesh, "unit-unknown"));
    }
  const auto child = import_obj(mapped(figure(), [](const Vec3& p) { return Vec3(55.0 * p); }));
  CHECK(child.unit == "cm");
}

TEST_CASE("a body that fits no unit is scaled to a person's size, with a warning") {
  for (const double scale : {1e-6, 3.0, 1e6}) {
    CAPTURE(scale);
    const auto mesh = import_obj(mapped(figure(), [&](const Vec3& p) { return Vec3(scale * p); }));
    CHECK(mesh.unit == "unknown");
    CHECK(warned(mesh, "unit-unknown"));
    CHECK(height(mesh.skin) == doctest::Approx(1.7).epsilon(0.1));
    CHECK(mesh.frame.to_file(mesh.skin.positions[0]).norm() < 3.0 * scale);
  }
}

TEST_CASE("a given unit is kept, with a warning where it makes no person's size") {
  const auto in_feet = mapped(figure(), [](const Vec3& p) { return Vec3(p / 0.3048); });
  const auto mesh = import_obj(in_feet, {.unit = io::Unit::kFoot});
  CHECK(mesh.unit == "ft");
  CHECK(height(mesh.skin) == doctest::Approx(1.7).epsilon(1e-3));
  CHECK(mesh.warnings.empty());
  for (const io::Unit unit : {io::Unit::kMillimeter, io::Unit::kCentimeter}) {
    const auto tiny = import_obj(figure(), {.unit = unit});
    CHECK(tiny.frame.meters_per_unit == (unit == io::Unit::kMillimeter ? 0.001 : 0.01));
    CHECK(warned(tiny, "unit-unlikely"));
  }
}

TEST_CASE("a file's unit that contradicts the shape is replaced, with a warning") {
  const TempFolder folder;
  const auto result =
      io::import_body(kContext, folder.write("a.dae", to_collada({{"body", figure()}}, 100.0, "Y_UP")));
  REQUIRE(result.ok());
  CHECK(result->unit == "m");
  CHECK(warned(*result, "unit-contradicted"));
}

TEST_CASE("the up axis follows from the shape, and options override") {
  const std::array<TriMesh, 3> turned = {
      mapped(figure(), [](const Vec3& p) { return Vec3(p.y(), p.z(), p.x()); }), figure(),
      mapped(figure(), [](const Vec3& p) { return Vec3(p.z(), p.x(), p.y()); })};
  for (int up = 0; up < 3; ++up) {
    CAPTURE(up);
    const auto mesh = import_obj(turned[static_cast<std::size_t>(up)]);
    CHECK(static_cast<int>(mesh.frame.up) == up);
    CHECK(height(mesh.skin) == doctest::Approx(1.7).epsilon(1e-3));
  }
  const auto given = import_obj(figure(), {.unit = io::Unit::kCentimeter, .up = geometry::Axis::kX});
  CHECK(given.frame.up == geometry::Axis::kX);
  CHECK(given.unit == "cm");
  CHECK(geometry::bounding_box(given.skin.positions).size().norm() < 0.02);
}

TEST_CASE("arms as wide as the body is tall do not change the up axis, y or z") {
  TriMesh cross = figure();
  for (Vec3& p : cross.positions) {
    const bool arm = p.y() > 1.2 && p.y() < 1.5;
    if (arm) p.x() *= 4.0;
  }
  CHECK(import_obj(cross).frame.up == geometry::Axis::kY);
  const TriMesh lying = mapped(cross, [](const Vec3& p) { return Vec3(p.x(), -p.z(), p.y()); });
  CHECK(import_obj(lying).frame.up == geometry::Axis::kZ);
}

TEST_CASE("the noise of a scan is smoothed and stated, or kept where that is wanted") {
  TriMesh noisy = bodice_test::icosphere(0.37, 5);
  engine::Random random(5);
  for (Vec3& p : noisy.positions) p *= 1.0 + 0.002 * random.normal() / 0.37;
  const io::ImportedMesh smooth = import_obj(noisy), kept = import_obj(noisy, {.keep_noise = true});
  for (const io::ImportedMesh* mesh : {&smooth, &kept})
    CHECK(mesh->noise_m == doctest::Approx(0.002).epsilon(0.1));
  CHECK(smooth.smoothed);
  CHECK(warned(smooth, "noise-smoothed"));
  CHECK_FALSE(kept.smoothed);
  CHECK(warned(kept, "noise-kept"));
  const auto mean_off = [](const io::ImportedMesh& mesh) {
    double sum = 0.0;
    for (const Vec3& p : mesh.skin.positions) sum += std::abs(p.norm() - 0.37);
    return sum / static_cast<double>(mesh.skin.positions.size());
  };
  CHECK(mean_off(kept) > 0.0014);
  CHECK(mean_off(smooth) < 0.0006);
  const io::ImportedMesh clean = import_obj(bodice_test::icosphere(0.37, 5));
  CHECK(clean.noise_m == 0.0);
  CHECK_FALSE(clean.smoothed);
}

TEST_CASE("a skin of many vertices is thinned, with a warning and a map, unless all are to be kept") {
  TriMesh fine = bodice_test::icosphere(0.37, 8);  // 655,362 vertices, .002 m apart
  for (Vec3& p : fine.positions) p = {p.x(), 2.0 * p.y(), p.z()};
  const TempFolder folder;
  const auto file = folder.write("fine.ply", to_ply(fine, true));
  const auto thinned = io::import_body(kContext, file),
             all = io::import_body(kContext, file, {.keep_vertices = true});
  REQUIRE(thinned.ok());
  REQUIRE(all.ok());
  CHECK(warned(*thinned, "skin-thinned"));
  CHECK_FALSE(warned(*all, "skin-thinned"));
  CHECK(all->skin.positions.size() == fine.positions.size());
  CHECK(thinned->skin.positions.size() < 300'000);
  CHECK(thinned->input_vertices == fine.positions.size());
  REQUIRE(thinned->vertex_of_input.size() == fine.positions.size());
  double farthest_m = 0.0;
  for (std::size_t v = 0; v < fine.positions.size(); ++v) {
    const Vec3 to = thinned->frame.to_file(thinned->skin.positions[thinned->vertex_of_input[v]]);
    farthest_m = std::max(farthest_m, (to - fine.positions[v]).norm());
  }
  CHECK(farthest_m < 0.015);
  CHECK(geometry::surface_area(thinned->skin) ==
        doctest::Approx(geometry::surface_area(all->skin)).epsilon(1e-3));
}
