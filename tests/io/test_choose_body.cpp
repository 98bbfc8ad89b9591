#include <doctest/doctest.h>

#include <bodice/geometry/mesh_distance.hpp>
#include <bodice/io/import.hpp>
#include <bodice_test/shapes.hpp>
#include <bodice_test/temp_folder.hpp>

#include "figure.hpp"

using namespace bodice;
using namespace io_test;
using bodice_test::box;
using bodice_test::cylinder;
using bodice_test::icosphere;
using bodice_test::sheet;
using bodice_test::TempFolder;

namespace {

engine::Result<io::ImportedMesh> import_groups(const std::vector<NamedMesh>& groups,
                                               std::optional<std::string> mesh = {}) {
  const TempFolder folder;
  return io::import_body(kContext, folder.write("a.obj", to_obj(groups)), {.mesh = std::move(mesh)});
}

TriMesh moved(const TriMesh& mesh, const Vec3& by) {
  return mapped(mesh, [&](const Vec3& p) { return Vec3(p + by); });
}

/// A skirt, open at both ends, around the figure's hips and of more area than they have.
TriMesh skirt() {
  return moved(cylinder(0.45, 0.8, 48, 12, false), {0.0, 0.6, 0.0});
}

TriMesh eye(double x) {
  return icosphere(0.012, 2, {x, 1.55, 0.12});
}

const engine::Warning* find(const io::ImportedMesh& mesh, std::string_view code) {
  for (const engine::Warning& warning : mesh.warnings)
    if (warning.code == code) return &warning;
  return nullptr;
}

/// The triangles of the figure that `keep` accepts by the height of their middle.
template <class Keep>
TriMesh part_of_figure(Keep&& keep) {
  TriMesh part = figure();
  std::erase_if(part.triangles, [&](const geometry::Triangle& t) {
    return !keep((part.positions[t[0]].y() + part.positions[t[1]].y() + part.positions[t[2]].y()) / 3.0);
  });
  return part;
}

}  // namespace

TEST_CASE("the body is found whatever the order and the names") {
  for (const bool body_first : {true, false}) {
    std::vector<NamedMesh> groups = {
        {"one", moved(box(Vec3::Constant(0.03)), {0.0, 2.0, 0.0})},
        {"two", skirt()},
        {"three", bodice_test::joined(eye(-0.04), eye(0.04))},
        {"four", moved(sheet(5.0, 5.0, 12, 12), {0.0, -0.001, 0.0})},
        {"five", moved(box({3.0, 1.5, 3.0}, 8), {0.0, 1.5, 0.0})},
    };
    groups.insert(body_first ? groups.begin() : groups.end(), {"six", figure()});
    const auto result = import_groups(groups);
    REQUIRE(result.ok());
    CHECK(result->mesh == "six");
    CHECK(vertex_distance(result->skin, figure()) < 1e-6);
    REQUIRE(find(*result, "pieces-left-out"));
    CHECK(find(*result, "pieces-left-out")->message.find("'two'") != std::string::npos);
  }
}

TEST_CASE("loose pieces of one single mesh are distinguished as well") {
  TriMesh all = bodice_test::joined(bodice_test::joined(eye(-0.04), eye(0.04)), skirt());
  all = bodice_test::joined(all, figure());
  const auto result = import_groups({{"", all}});
  REQUIRE(result.ok());
  CHECK(vertex_distance(result->skin, figure()) < 1e-6);
  CHECK(result->input_vertices == all.positions.size());
}

TEST_CASE("one body in several materials is joined along their borders") {
  const TriMesh whole = figure();
  const auto result = import_groups({{"trousers", part_of_figure([](double y) { return y < 0.9; })},
                                     {"skin", part_of_figure([](double y) { return y >= 0.9; })}});
  REQUIRE(result.ok());
  CHECK(result->skin.triangles.size() == whole.triangles.size());
  CHECK(result->repair.components == 1);
  CHECK(result->repair.boundary_edges == 0);
  CHECK(find(*result, "body-joined"));
}

TEST_CASE("limbs that are closed pieces of their own belong to the body") {
  const TriMesh arm_l = icosphere(1.0, 2), torso = figure();
  const TriMesh arm =
      mapped(arm_l, [](const Vec3& p) { return Vec3(0.55 + 0.3 * p.x(), 1.2 + 0.05 * p.y(), 0.05 * p.z()); });
  const TriMesh other = mapped(arm, [](const Vec3& p) { return Vec3(-p.x(), p.y(), p.z()); });
  const auto result = import_groups({{"torso", torso}, {"arm_l", arm}, {"arm_r", other}, {"skirt", skirt()}});
  REQUIRE(result.ok());
  CHECK(result->repair.components == 3);
  CHECK(geometry::bounding_box(result->skin.positions).size().x() == doctest::Approx(1.7).epsilon(0.01));
}

TEST_CASE("of two people beside each other the file's first is taken, and the other by its number") {
  const TriMesh second =
      moved(mapped(figure(), [](const Vec3& p) { return Vec3(1.1 * p); }), {0.9, 0.0, 0.0});
  const TempFolder folder;
  const auto file = folder.write("two.obj", to_obj({{"", bodice_test::joined(figure(), second)}}));
  const auto first = io::import_body(kContext, file), other = io::import_body(kContext, file, {.person = 2});
  REQUIRE(first.ok());
  REQUIRE(other.ok());
  CHECK(vertex_distance(first->skin, figure()) < 1e-6);
  CHECK(vertex_distance(other->skin, second) < 1e-6);
  REQUIRE(find(*first, "several-people"));
  CHECK(find(*first, "several-people")->note);
  const auto third = io::import_body(kContext, file, {.person = 3});
  REQUIRE(!third.ok());
  CHECK(third.error().code == engine::ErrorCode::kNotFound);
  CHECK(third.error().remedy.find("1 to 2") != std::string::npos);
}

TEST_CASE("a small child before an adult is number two") {
  const TriMesh child = moved(mapped(figure(), [](const Vec3& p) { return Vec3(0.6 * p); }), {0.9, 0.0, 0.0});
  const TempFolder folder;
  const auto file = folder.write("two.obj", to_obj({{"", bodice_test::joined(child, figure())}}));
  const auto first = io::import_body(kContext, file), other = io::import_body(kContext, file, {.person = 2});
  REQUIRE(first.ok());
  REQUIRE(other.ok());
  CHECK(vertex_distance(first->skin, figure()) < 1e-6);
  CHECK(vertex_distance(other->skin, child) < 1e-6);
}

TEST_CASE("a floor is no body, even where the body has so many holes that it is less closed") {
  TriMesh holed = figure();
  std::size_t next = 0;
  std::erase_if(holed.triangles, [&](const geometry::Triangle&) { return next++ % 3 == 0; });
  const auto result = import_groups({{"", bodice_test::joined(holed, sheet(3.0, 3.0, 24, 24))}});
  REQUIRE(result.ok());
  CHECK(geometry::bounding_box(result->skin.positions).size().x() < 2.0);
}

TEST_CASE("a chair in the mesh of the body is left out") {
  TriMesh all = figure();
  all = bodice_test::joined(all, box({0.22, 0.02, 0.22}, 4, {0.0, 0.45, 0.1}));
  all = bodice_test::joined(all, box({0.22, 0.25, 0.02}, 4, {0.0, 0.7, -0.15}));
  all = bodice_test::joined(all, box({0.02, 0.22, 0.02}, 4, {0.2, 0.2, 0.3}));
  const auto result = import_groups({{"", all}});
  REQUIRE(result.ok());
  CHECK(vertex_distance(result->skin, figure()) < 1e-6);
  CHECK(find(*result, "pieces-left-out"));
}

TEST_CASE("a body of loose patches is assembled and closed, with debris around it left out") {
  const TriMesh whole = figure();
  std::vector<TriMesh> patches(4);
  for (std::size_t k = 0; k < patches.size(); ++k) {
    patches[k] = part_of_figure([&](double y) { return static_cast<std::size_t>(y / 0.43) == k; });
    patches[k] = moved(patches[k], {0.002 * static_cast<double>(k % 2), 0.0, 0.0});
  }
  TriMesh all = icosphere(0.01, 0, {1.5, 1.0, 0.0});
  for (const TriMesh& patch : patches) all = bodice_test::joined(all, patch);
  const auto result = import_groups({{"", all}});
  REQUIRE(result.ok());
  CHECK(result->repair.boundary_edges == 0);
  CHECK(result->repair.components == 1);
  CHECK(signed_volume(result->skin) == doctest::Approx(signed_volume(whole)).epsilon(0.02));
  CHECK(find(*result, "skin-rebuilt"));
  CHECK(find(*result, "pieces-left-out"));
  CHECK(!find(*result, "skin-lost"));
  const geometry::MeshDistance truth(kContext, whole);
  for (const Vec3& p : result->skin.positions) CHECK(std::abs(truth.signed_distance(p)) < 0.02);
}

TEST_CASE("tips that are thinner than the cells of a closed skin are in it") {
  TriMesh all = part_of_figure([](double y) { return y < 0.8 || y > 0.86; });  // open around the waist
  const std::size_t vertices = all.positions.size();
  for (std::size_t k = 0; k < vertices; k += 40) {  // a needle of 60 mm on a triangle of 6 mm
    const Vec3 at = all.positions[k], out = Vec3(at.x(), 0.1, at.z()).normalized();
    const Vec3 across = out.cross(Vec3::UnitY()).normalized(), up = across.cross(out);
    const auto first = static_cast<geometry::Index>(all.positions.size());
    for (const Vec3& corner :
         {Vec3(0.003 * across), Vec3(0.003 * up), Vec3(-0.003 * across), Vec3(0.06 * out)})
      all.positions.push_back(at + corner);
    for (const geometry::Index c : {0U, 1U, 2U})
      all.triangles.push_back({first + c, first + (c + 1) % 3, first + 3});
    all.triangles.push_back({first, first + 1, static_cast<geometry::Index>(k)});
  }
  const auto result = import_groups({{"", all}});
  REQUIRE(result.ok());
  CHECK(find(*result, "skin-rebuilt"));
  CHECK(!find(*result, "skin-lost"));
  const geometry::MeshDistance skin(kContext, result->skin);
  for (std::size_t v = vertices; v < all.positions.size(); ++v)
    CHECK(skin.signed_distance(all.positions[v]) < 0.012);
}

TEST_CASE("an open surface of a few triangles is not rebuilt") {
  TriMesh open = icosphere(0.2, 0, {0.0, 1.0, 0.0});  // 20 triangles
  open.triangles.resize(8);
  const auto result = import_groups({{"", open}});
  REQUIRE(result.ok());
  CHECK(result->skin.triangles.size() == 8);
  CHECK(!find(*result, "skin-rebuilt"));
}

TEST_CASE("a mesh is taken by its name, and a wrong name is an error that lists the names") {
  const std::vector<NamedMesh> groups = {{"body", figure()}, {"Skirt", skirt()}};
  const auto skirt_only = import_groups(groups, "skirt");
  REQUIRE(skirt_only.ok());
  CHECK(skirt_only->mesh == "Skirt");
  CHECK(skirt_only->input_triangles == skirt().triangles.size());
  const auto missing = import_groups(groups, "torso");
  REQUIRE(!missing.ok());
  CHECK(missing.error().code == engine::ErrorCode::kNotFound);
  CHECK(missing.error().message.find("'torso'") != std::string::npos);
  CHECK(missing.error().remedy.find("'Skirt'") != std::string::npos);
}
