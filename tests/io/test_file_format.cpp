// A file is what its content is, whatever its name, and what has none of the mesh formats is read by nothing.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>

#include <bodice/io/import.hpp>
#include <bodice/io/rig.hpp>
#include <bodice_test/data.hpp>
#include <bodice_test/temp_folder.hpp>

#include "figure.hpp"

using namespace bodice;
using namespace io_test;
using bodice_test::TempFolder;

namespace {

struct Content {
  const char* extension;
  std::string bytes;
};

std::vector<Content> all_formats() {
  return {{"obj", to_obj({{"body", figure()}})},
          {"ply", to_ply(figure(), false)},
          {"ply", to_ply(figure(), true)},
          {"stl", to_stl(figure(), false)},
          {"stl", to_stl(figure(), true)},
          {"gltf", to_gltf(figure(), kIdentity)},
          {"dae", to_collada({{"b", figure()}}, 1.0, "Y_UP")}};
}

/// Checks that the refusal names the file and the formats that are read.
void check_unknown(const std::filesystem::path& file) {
  CAPTURE(file);
  const auto result = io::import_body({}, file);
  REQUIRE(!result.ok());
  CHECK(result.error().code == engine::ErrorCode::kUnreadable);
  CHECK(result.error().message == "'" + file.string() + "' holds no " + std::string(io::kMeshFormats) + ".");
  CHECK(result.error().remedy == "Export it again as " + std::string(io::kMeshFormats) + ".");
}

}  // namespace

TEST_CASE("the buffers of a glTF document are files beside it, and other files have none") {
  const TempFolder folder;
  const auto beside = io::files_beside(folder.write("a.gltf", R"({"asset": {"version": "2.0"}, "buffers": [
      {"byteLength": 4, "uri": "a%20b.bin"}, {"byteLength": 4, "uri": "data:;base64,AAAAAA=="},
      {"byteLength": 4}, {"byteLength": 4, "uri": "sub/c.bin"}]})"));
  REQUIRE(beside.size() == 2);
  CHECK(beside[0] == folder.path() / "a b.bin");
  CHECK(beside[1] == folder.path() / "sub/c.bin");
  for (const Content& content : all_formats())
    CHECK(io::files_beside(folder.write("a." + std::string(content.extension), content.bytes)).empty());
  CHECK(io::files_beside(folder.path() / "missing.gltf").empty());
}

TEST_CASE("a mesh is read by its content under the extension of any other format") {
  const TempFolder folder;
  for (const Content& content : all_formats())
    for (const char* extension :
         {"obj", "ply", "stl", "gltf", "glb", "fbx", "dae", "zae", "3ds", "off", "txt", ""}) {
      const auto file = folder.write(std::string("a.") + extension, content.bytes);
      CAPTURE(content.extension);
      CAPTURE(extension);
      const auto result = io::import_body({}, file);
      REQUIRE(result.ok());
      CHECK(vertex_distance(result->skin, figure()) < 2e-6);
    }
}

TEST_CASE("files of other formats are refused whatever their name") {
  const std::vector<std::string> others = {
      "OFF\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n",
      "3DM\n0 0 0 1 0 0 0 1 0\n0 0 1 1 0 0 0 1 0\n",
      "xof 0302txt 0064\nHeader { 1; 0; 1; }\nMesh { 3; 0;0;0;, 1;0;0;, 0;1;0;; 1; 3;0,1,2;; }\n",
      "AC3Db\nMATERIAL \"\" rgb 1 1 1\n",
      "ISO-10303-21;\nHEADER;\nENDSEC;\n",
      "<?xml version=\"1.0\"?><mesh xmlns=\"http://irrlicht.sourceforge.net/\"></mesh>",
      "v\nfrom 0 0 0\nat 0 0 1\nup 0 1 0\nf 1 0 0 1 0 0 0 0\np 3\n0 0 0\n1 0 0\n0 1 0\n",
      "{\"meshes\": []}",
      "IDP2\x08",
      std::string("PK\3\4 3D/3dmodel.model"),
      std::string("MM\0\x10", 4)};
  const TempFolder folder;
  for (const std::string& bytes : others)
    for (const char* extension : {"obj", "off", "raw", "x", "stl", "ply", "glb", "dae", "zae", "fbx"})
      check_unknown(folder.write(std::string("b.") + extension, bytes));
}

TEST_CASE("glTF of version 1 and motions without a mesh are refused by name") {
  const TempFolder folder;
  const auto old = io::import_body({}, folder.write("old.gltf", R"({"asset": {"version": "1.0"}})"));
  REQUIRE(!old.ok());
  CHECK(old.error().message.find("glTF 2") != std::string::npos);
  const auto motion = io::import_body({}, folder.write("walk.obj", "HIERARCHY\nROOT hips\n{\n}\n"));
  REQUIRE(!motion.ok());
  CHECK(motion.error().message.find("BVH") != std::string::npos);
}

TEST_CASE("a real block figure in IQM is refused, because its reader is not promised") {
  const auto file = bodice_test::data_file("rigs/thirdparty/guy.iqm");
  if (file) check_unknown(*file);
}

TEST_CASE("no file of Debian's model collection crashes or hangs, and only the mesh formats are read") {
  const std::filesystem::path models = "/usr/share/assimp/models";
  if (!std::filesystem::exists(models)) {
    MESSAGE("skipped: package assimp-testmodels is not installed");
    return;
  }
  std::size_t read = 0, refused = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(models)) {
    if (!entry.is_regular_file()) continue;
    CAPTURE(entry.path());
    const auto result = io::import_body({}, entry.path());
    ++(result.ok() ? read : refused);
    if (result.ok()) continue;
    CHECK(!result.error().message.empty());
    CHECK(result.error().message.find('\n') == std::string::npos);
  }
  CHECK(read > 80);
  CHECK(refused > 300);
}
