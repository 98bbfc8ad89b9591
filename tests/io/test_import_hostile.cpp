#include <doctest/doctest.h>

#include <bodice/engine/random.hpp>
#include <bodice/io/import.hpp>
#include <bodice_test/temp_folder.hpp>

#include "figure.hpp"

using namespace bodice;
using namespace io_test;
using bodice_test::TempFolder;

namespace {

/// Checks that the error names the file, and has a sentence and a remedy.
void check_error(const std::filesystem::path& file, engine::ErrorCode code) {
  CAPTURE(file);
  const auto result = io::import_body(kContext, file);
  REQUIRE(!result.ok());
  CHECK(result.error().code == code);
  CHECK(result.error().message.find(file.string()) != std::string::npos);
  CHECK(result.error().message.find('\n') == std::string::npos);
  CHECK(result.error().message.ends_with('.'));
  CHECK(!result.error().remedy.empty());
}

/// Checks that there is no crash, no hang and no number that is not finite.
void check_survives(const std::filesystem::path& file) {
  CAPTURE(file);
  const auto result = io::import_body(kContext, file);
  if (!result.ok()) {
    CHECK(!result.error().message.empty());
    return;
  }
  for (const Vec3& p : result->skin.positions) CHECK(p.allFinite());
  for (const auto& t : result->skin.triangles)
    for (const auto v : t) CHECK(v < result->skin.positions.size());
}

std::string random_bytes(std::size_t count, std::uint64_t seed) {
  engine::Random random(seed);
  std::string bytes(count, '\0');
  for (char& byte : bytes) byte = static_cast<char>(random.below(256));
  return bytes;
}

}  // namespace

TEST_CASE("a file that is no mesh is refused in one sentence with a remedy") {
  const TempFolder folder;
  check_error(folder / "missing.obj", engine::ErrorCode::kNotFound);
  check_error(folder.path(), engine::ErrorCode::kUnreadable);
  for (const char* extension : {"obj", "ply", "stl", "gltf", "glb", "fbx", "dae", "zae", "txt", ""}) {
    const std::string name = std::string("file.") + extension;
    check_error(folder.write("empty_" + name, ""), engine::ErrorCode::kUnreadable);
    check_error(folder.write("text_" + name, "Dear reader, this is a letter and no mesh.\n"),
                engine::ErrorCode::kUnreadable);
    check_error(folder.write("bytes_" + name, random_bytes(300, 7)), engine::ErrorCode::kUnreadable);
  }
}

TEST_CASE("a GLB with chunks that would end beyond the file is refused before any of it is allocated") {
  const TempFolder folder;
  const auto word = [](std::uint32_t value) {
    return std::string{static_cast<char>(value & 255u), static_cast<char>(value >> 8 & 255u),
                       static_cast<char>(value >> 16 & 255u), static_cast<char>(value >> 24)};
  };
  const std::string chunk = R"({"asset":{"version":"2.0"}}  )";
  const std::uint32_t huge = 2'200'000'000;
  const auto file = [&](std::uint32_t all, std::uint32_t first, const std::string& more) {
    return "glTF" + word(2) + word(all) + word(first) + "JSON" + chunk + more;
  };
  const auto length = static_cast<std::uint32_t>(chunk.size());
  const std::string files[] = {file(huge + 20, huge, ""), file(20 + length, huge, ""),
                               file(28 + length, length, word(huge) + std::string("BIN\0", 4))};
  for (const std::string& bytes : files) {
    const auto path = folder.write("huge.glb", bytes);
    check_error(path, engine::ErrorCode::kUnreadable);
    CHECK(io::import_body(kContext, path).error().message.find("GLB") != std::string::npos);
  }
}

TEST_CASE("points and lines alone are no body") {
  const TempFolder folder;
  check_error(folder.write("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\np 1 2 3\nl 1 2\n"),
              engine::ErrorCode::kUnreadable);
  check_error(folder.write("no_faces.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"), engine::ErrorCode::kUnreadable);
}

TEST_CASE("a surface without area is unusable") {
  const TempFolder folder;
  check_error(folder.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\nf 1 1 2\n"),
              engine::ErrorCode::kUnusableGeometry);
}

TEST_CASE("vertices that are not numbers are dropped and reported") {
  const TempFolder folder;
  TriMesh broken = figure();
  broken.positions[10].x() = std::numeric_limits<double>::quiet_NaN();
  broken.positions[20].y() = std::numeric_limits<double>::infinity();
  const auto result = io::import_body(kContext, folder.write("nan.ply", to_ply(broken, true)));
  REQUIRE(result.ok());
  CHECK(result->repair.dropped_vertices == 2);
  CHECK(result->vertex_of_input[10] == geometry::kNoIndex);
  CHECK(result->skin.positions.size() == broken.positions.size() - 2);
  bool reported = false;
  for (const engine::Warning& warning : result->warnings) reported |= warning.code == "non-finite-vertices";
  CHECK(reported);
}

TEST_CASE("truncated files are read as far as they go or refused, never crash") {
  const TempFolder folder;
  const std::vector<std::pair<std::string, std::string>> files = {
      {"a.obj", to_obj({{"body", figure()}})},
      {"a.ply", to_ply(figure(), false)},
      {"b.ply", to_ply(figure(), true)},
      {"a.stl", to_stl(figure(), false)},
      {"b.stl", to_stl(figure(), true)},
      {"a.dae", to_collada({{"b", figure()}}, 1.0, "Y_UP")},
      {"a.gltf", to_gltf(figure(), "[1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]")}};
  for (const auto& [name, bytes] : files)
    for (const double part : {0.02, 0.3, 0.6, 0.95})
      check_survives(
          folder.write(std::to_string(part) + name,
                       bytes.substr(0, static_cast<std::size_t>(part * static_cast<double>(bytes.size())))));
}

TEST_CASE("indices beyond the vertices are left out") {
  const TempFolder folder;
  check_survives(
      folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 99\nf 1 2 3\nf -1 -2 -3\nf 0 1 2\n"));
}
