#include <doctest/doctest.h>

#include <cstdio>
#include <cstring>

#include <bodice/io/import.hpp>
#include <bodice_test/temp_folder.hpp>

#include "figure.hpp"

using namespace bodice;
using namespace io_test;
using bodice_test::TempFolder;

namespace {

io::ImportedMesh read_body(const std::filesystem::path& file) {
  auto result = io::import_body(kContext, file);
  REQUIRE_MESSAGE(result.ok(), (result.ok() ? std::string() : result.error().sentence()));
  return std::move(*result);
}

void check_same(const io::ImportedMesh& a, const io::ImportedMesh& b) {
  CHECK(a.skin.positions == b.skin.positions);
  CHECK(a.skin.triangles == b.skin.triangles);
  CHECK(a.vertex_of_input == b.vertex_of_input);
  CHECK(a.frame.meters_per_unit == b.frame.meters_per_unit);
  CHECK(a.input_vertices == b.input_vertices);
  CHECK(a.mesh == b.mesh);
}

/// The figure, one vertex of it twice, with numbers of many forms and quads where two triangles follow each
/// other.
std::string varied_obj(const std::string& vertex_tail, const std::string& corner_tail) {
  constexpr const char* kForms[] = {"%.9g", "%+.17f", "%.3e", "%.12E", "%.25f", "%.1f"};
  const TriMesh mesh = figure();
  std::string text = "# a figure\r\nmtllib none.mtl\ng  body\r\n\nv 7 7 7" + vertex_tail + "\n";
  std::size_t form = 0;
  const auto add_vertex = [&](const Vec3& p) {
    text += "v";
    for (const double x : p) {
      char number[64];
      std::snprintf(number, sizeof number, kForms[form++ % std::size(kForms)], x);
      text += std::string(form % 3 == 0 ? " \t" : " ") + number;
    }
    text += vertex_tail + "\n";
  };
  for (const Vec3& p : mesh.positions) add_vertex(p);
  text +=
      "v 0.125 0.25 -0" + vertex_tail + "\nv 0.125 0.25 0" + vertex_tail + "\nvn 0 1 0\nvt 0.5 0.5\ns off\n";
  const auto corner = [&](std::size_t v) { return ' ' + std::to_string(v + 2) + corner_tail; };
  for (const auto& [a, b, c] : mesh.triangles) text += "f" + corner(a) + corner(b) + corner(c) + "\n";
  const std::size_t more = mesh.positions.size();
  text +=
      "f" + corner(0) + corner(1) + corner(more) + "\nf" + corner(1) + corner(2) + corner(more + 1) + "\n";
  return text + "f" + corner(0) + corner(1) + corner(2) + corner(more) + "  \r\n";
}

}  // namespace

TEST_CASE("an OBJ that is plain gives the same bits as one that assimp reads") {
  const TempFolder folder;
  const char* tails[][2] = {{"", ""}, {" 0.5 1 0.25", ""}, {"", "/1"}, {"  ", "//1"}, {"\r", "/1/1"}};
  for (const auto& [vertex_tail, corner_tail] : tails) {
    const std::string text = varied_obj(vertex_tail, corner_tail);
    const auto plain = read_body(folder.write("figure.obj", text));
    check_same(plain, read_body(folder.write("figure.obj", text + "l 2 3\n")));  // lines are not plain
    CHECK(plain.mesh == "body");
  }
}

TEST_CASE("an OBJ with later names, negative indices or lines that go on is read as before") {
  const TempFolder folder;
  const TriMesh mesh = figure();
  const std::string text = to_obj({{"", mesh}});
  const auto plain = read_body(folder.write("a.obj", text));
  const std::size_t last = text.rfind("\nf ");
  const std::string before = text.substr(0, last + 1), face = text.substr(last + 1);
  check_same(plain, read_body(folder.write("a.obj", before + "usemtl b\n" + face)));
  check_same(plain, read_body(folder.write("a.obj", before + "f\\\n" + face.substr(1))));
  std::string negative = "f";
  for (const auto v : mesh.triangles.back()) negative += " -" + std::to_string(mesh.positions.size() - v);
  check_same(plain, read_body(folder.write("a.obj", before + negative + "\n")));
}

TEST_CASE("a binary PLY that is plain gives the same bits as one that assimp reads") {
  const TempFolder folder;
  const TriMesh mesh = figure();
  const auto header = [&](const char* count) {
    return "ply\nformat binary_little_endian 1.0\ncomment a figure\nelement vertex " +
           std::to_string(mesh.positions.size()) +
           "\nproperty uchar red\nproperty float32 z\nproperty float x\nproperty float y\nproperty double s\n"
           "element face " +
           std::to_string(mesh.triangles.size()) + "\nproperty list " + count +
           " int32 vertex_index\nend_header\n";
  };
  const auto append = [](std::string& bytes, auto value) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    bytes.append(raw, sizeof value);
  };
  std::string vertices, plain_faces, other_faces;
  for (const Vec3& p : mesh.positions) {
    append(vertices, std::uint8_t{200});
    for (const double x : {p.z(), p.x(), p.y()}) append(vertices, static_cast<float>(x));
    append(vertices, 0.5);
  }
  for (const auto& triangle : mesh.triangles) {
    append(plain_faces, std::uint8_t{3});
    append(other_faces, std::int32_t{3});
    for (const auto v : triangle) append(plain_faces, v), append(other_faces, v);
  }
  const auto plain = read_body(folder.write("figure.ply", header("uchar") + vertices + plain_faces));
  check_same(plain, read_body(folder.write("figure.ply", header("int") + vertices + other_faces)));
  CHECK(plain.mesh == "figure");
  CHECK(vertex_distance(plain.skin, mesh) < 2e-6);
}
