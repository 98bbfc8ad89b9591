#include <doctest/doctest.h>

#include <bodice/geometry/tri_mesh.hpp>
#include <bodice/io/import.hpp>
#include <bodice_test/temp_folder.hpp>

#include "figure.hpp"

using namespace bodice;
using namespace io_test;
using bodice_test::TempFolder;

namespace {

/// Imports a body and checks that it is the figure, in meters and y up.
io::ImportedMesh import_figure(const std::filesystem::path& file, double tolerance_m = 2e-6) {
  auto result = io::import_body(kContext, file);
  REQUIRE_MESSAGE(result.ok(), (result.ok() ? std::string() : result.error().sentence()));
  const TriMesh truth = figure();
  CHECK(result->skin.positions.size() == truth.positions.size());
  CHECK(result->skin.triangles.size() == truth.triangles.size());
  CHECK(vertex_distance(result->skin, truth) < tolerance_m);
  CHECK(signed_volume(result->skin) == doctest::Approx(signed_volume(truth)).epsilon(1e-4));
  CHECK(result->repair.boundary_edges == 0);
  CHECK(result->vertex_of_input.size() == result->input_vertices);
  return std::move(*result);
}

/// The column-major matrix from z up to y up, as Blender writes it.
constexpr const char* kTurned = "[1,0,0,0, 0,0,-1,0, 0,1,0,0, 0,0,0,1]";

TriMesh z_up(double scale) {
  return mapped(figure(), [&](const Vec3& p) { return Vec3(scale * Vec3(p.x(), -p.z(), p.y())); });
}

}  // namespace

TEST_CASE("every format gives the same figure") {
  const TempFolder folder;
  const std::size_t vertices = figure().positions.size(), corners = 3 * figure().triangles.size();
  SUBCASE("OBJ: its own vertices, though the reader splits them by corner") {
    const auto mesh = import_figure(folder.write("a.obj", to_obj({{"", figure()}})));
    CHECK(mesh.input_vertices == vertices);
    CHECK(mesh.repair.welded == 0);
    CHECK(mesh.mesh == "a");
  }
  SUBCASE("PLY, text") {
    CHECK(import_figure(folder.write("a.ply", to_ply(figure(), false))).repair.welded == 0);
  }
  SUBCASE("PLY, binary") {
    CHECK(import_figure(folder.write("a.ply", to_ply(figure(), true))).unit == "m");
  }
  SUBCASE("STL, text") {
    CHECK(import_figure(folder.write("a.stl", to_stl(figure(), false))).repair.welded == corners - vertices);
  }
  SUBCASE("STL, binary") {
    CHECK(import_figure(folder.write("a.stl", to_stl(figure(), true))).input_vertices == corners);
  }
  SUBCASE("glTF") {
    CHECK(import_figure(folder.write("a.gltf", to_gltf(figure(), kIdentity))).mesh == "figure");
  }
  SUBCASE("Collada") {
    const auto mesh = import_figure(folder.write("a.dae", to_collada({{"body", figure()}}, 1.0, "Y_UP")));
    CHECK(mesh.input_vertices == vertices);
  }
}

TEST_CASE("the transform of a glTF node is applied") {
  const TempFolder folder;
  import_figure(folder.write("turned.gltf", to_gltf(z_up(1.0), kTurned)));
}

TEST_CASE("a skinned mesh is placed by its bones and not by its node") {
  const TempFolder folder;
  const char* ten_times = "[10,0,0,0, 0,10,0,0, 0,0,10,0, 0,0,0,1]";
  SUBCASE("bones in place, node elsewhere") {
    import_figure(folder.write("skin.gltf", to_gltf(figure(), ten_times, kIdentity)));
  }
  SUBCASE("bones turn the stored mesh upright") {
    import_figure(folder.write("skin.gltf", to_gltf(z_up(1.0), kIdentity, kTurned)));
  }
}

TEST_CASE("Collada's unit and up axis make the frame, and its own coordinates are kept") {
  const TempFolder folder;
  const auto mesh = import_figure(folder.write("cm.dae", to_collada({{"body", z_up(100.0)}}, 0.01, "Z_UP")));
  CHECK(mesh.unit == "cm");
  CHECK(mesh.frame.up == geometry::Axis::kZ);
  CHECK(mesh.frame.meters_per_unit == doctest::Approx(0.01));
  const TriMesh back = mapped(mesh.skin, [&](const Vec3& p) { return mesh.frame.to_file(p); });
  CHECK(vertex_distance(back, z_up(100.0)) < 2e-4);
}

TEST_CASE("the map from the file's vertices leads to the same positions") {
  const TempFolder folder;
  const TriMesh truth = figure();
  const auto mesh = import_figure(folder.write("a.ply", to_ply(truth, true)));
  REQUIRE(mesh.vertex_of_input.size() == truth.positions.size());
  double worst = 0.0;
  for (std::size_t v = 0; v < truth.positions.size(); ++v) {
    REQUIRE(mesh.vertex_of_input[v] < mesh.skin.positions.size());
    worst = std::max(worst, (mesh.skin.positions[mesh.vertex_of_input[v]] - truth.positions[v]).norm());
  }
  CHECK(worst < 1e-6);
}

TEST_CASE("an OBJ ten kilometers from the origin keeps its digits") {
  const TempFolder folder;
  const Vec3 far(10'000.0, -3'000.0, 7'000.0);
  const TriMesh moved = mapped(figure(), [&](const Vec3& p) { return Vec3(p + far); });
  std::string text;
  for (const Vec3& p : moved.positions) {
    char line[96];
    std::snprintf(line, sizeof line, "v %.7f %.7f %.7f\r\n", p.x(), p.y(), p.z());
    text += line;
  }
  for (const auto& [a, b, c] : moved.triangles)
    text += "f " + std::to_string(a + 1) + ' ' + std::to_string(b + 1) + ' ' + std::to_string(c + 1) + "\r\n";
  const auto result = io::import_body(kContext, folder.write("far.obj", text));
  REQUIRE(result.ok());
  CHECK(result->skin.positions.size() == moved.positions.size());
  CHECK(vertex_distance(result->skin, moved) < 5e-7);
  for (const engine::Warning& warning : result->warnings) CHECK(warning.code != "far-from-origin");
}

TEST_CASE("a binary file far from the origin gives a warning with the error of single precision") {
  const TempFolder folder;
  const TriMesh moved = mapped(figure(), [](const Vec3& p) { return Vec3(p + Vec3(5000.0, 0.0, 0.0)); });
  const auto result = io::import_body(kContext, folder.write("far.ply", to_ply(moved, true)));
  REQUIRE(result.ok());
  CHECK(std::count_if(result->warnings.begin(), result->warnings.end(),
                      [](const engine::Warning& w) { return w.code == "far-from-origin"; }) == 1);
}
