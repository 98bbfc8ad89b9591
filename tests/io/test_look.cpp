// Materials, images, texture coordinates and names of a garment's file come back from the GLB of its drape.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>

#include <assimp/GltfMaterial.h>
#include <assimp/material.h>
#include <assimp/scene.h>
#include <assimp/Importer.hpp>
#include <bodice/io/cloth_cache.hpp>
#include <bodice/io/import.hpp>
#include <bodice/io/scene.hpp>
#include <bodice/io/scene_file.hpp>
#include <bodice_test/shapes.hpp>
#include <bodice_test/temp_folder.hpp>
#include <nlohmann/json.hpp>

#include "textured_tube.hpp"

using namespace bodice;
using namespace io_test;
using bodice_test::TempFolder;
using nlohmann::json;
using namespace std::string_literals;

namespace {

/// Writes a garment with a frame that is shifted, as a drape would.
io::GarmentTrack written(const io::ImportedMesh& garment, const std::filesystem::path& file) {
  io::Scene scene;
  io::GarmentTrack& track = scene.garments.emplace_back();
  track.name = "cloth";
  track.mesh = garment.skin;
  track.look = garment.look;
  track.frames = {garment.skin.positions, garment.skin.positions};
  for (Vec3& p : track.frames[1]) p += Vec3(0.125, 0.0, 0.25 * p.y());
  track.time_s = {0.0, 0.5};
  const auto done = io::write_glb(scene, file);
  REQUIRE_MESSAGE(done.ok(), (done.ok() ? std::string() : done.error().sentence()));
  return scene.garments[0];
}

/// All corners of a file's meshes as assimp reads them, sorted, with rounding removed; by material.
std::vector<Corner> corners_of(const aiScene& scene, std::string_view material) {
  std::vector<Corner> corners;
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    const aiMesh& mesh = *scene.mMeshes[m];
    if (scene.mMaterials[mesh.mMaterialIndex]->GetName().C_Str() != material) continue;
    for (unsigned f = 0; f < mesh.mNumFaces; ++f)
      for (unsigned k = 0; k < mesh.mFaces[f].mNumIndices; ++k) {
        const unsigned v = mesh.mFaces[f].mIndices[k];
        REQUIRE(mesh.HasTextureCoords(0));
        const aiVector3D &p = mesh.mVertices[v], &uv = mesh.mTextureCoords[0][v];
        Corner corner{p.x, p.y, p.z, uv.x, uv.y};
        for (double& value : corner) value = std::round(1e4 * value) / 1e4 + 0.0;
        corners.push_back(corner);
      }
  }
  std::ranges::sort(corners);
  return corners;
}

std::vector<Corner> expected(const Tube& tube, bool upper) {
  std::vector<Corner> corners;
  for (std::size_t i = 0; i < tube.corners.size(); ++i)
    if (tube.upper[i / 3] == upper) {
      Corner corner = tube.corners[i];
      for (double& value : corner) value = std::round(1e4 * value) / 1e4 + 0.0;
      corners.push_back(corner);
    }
  std::ranges::sort(corners);
  return corners;
}

json document_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  const auto length = static_cast<std::size_t>(static_cast<unsigned char>(bytes[12])) |
                      static_cast<std::size_t>(static_cast<unsigned char>(bytes[13])) << 8 |
                      static_cast<std::size_t>(static_cast<unsigned char>(bytes[14])) << 16;
  return json::parse(bytes.substr(20, length));
}

void check_read_by_assimp(const std::filesystem::path& file, const Tube& tube) {
  Assimp::Importer importer;
  const aiScene* read = importer.ReadFile(file.string(), 0);
  REQUIRE(read);
  CHECK(corners_of(*read, "Checks") == expected(tube, false));
  CHECK(corners_of(*read, "Band") == expected(tube, true));
  REQUIRE(read->mRootNode->FindNode("Tube"));
  CHECK(read->mRootNode->FindNode("Tube")->mNumMeshes == 2);
  REQUIRE(read->mNumTextures == 1);
  CHECK(std::string(reinterpret_cast<const char*>(read->mTextures[0]->pcData), read->mTextures[0]->mWidth) ==
        kPng);
  for (unsigned m = 0; m < read->mNumMaterials; ++m) {
    const aiMaterial& material = *read->mMaterials[m];
    const std::string name = material.GetName().C_Str();
    CHECK(material.GetTextureCount(aiTextureType_BASE_COLOR) == (name == "Checks" ? 1 : 0));
    aiColor4D color;
    if (name != "Band") continue;
    REQUIRE(material.Get(AI_MATKEY_BASE_COLOR, color) == aiReturn_SUCCESS);
    CHECK(static_cast<double>(color.r) == doctest::Approx(0.6));
    CHECK(static_cast<double>(color.b) == doctest::Approx(0.2));
    CHECK(static_cast<double>(color.a) == doctest::Approx(0.5));
  }
}

}  // namespace

TEST_CASE("an OBJ's textures, materials and name are in the GLB, across seams of the texture") {
  const TempFolder folder;
  const Tube tube;
  folder.write("tube.mtl", kMtl);
  folder.write("pixel one.png", kPng);
  const io::ImportedMesh garment = imported(folder.write("tube.obj", tube.obj()));
  CHECK(garment.warnings.empty());
  REQUIRE(garment.look);
  CHECK(garment.skin.positions.size() == tube.mesh.positions.size());  // the cloth is welded at its seam
  const io::GarmentTrack track = written(garment, folder / "out.glb");
  check_read_by_assimp(folder / "out.glb", tube);

  SUBCASE("the GLB is read back as the cloth that was draped") {
    const auto back = io::read_scene_file({}, folder / "out.glb");
    REQUIRE(back.ok());
    REQUIRE(back->garments.size() == 1);
    const io::GarmentTrack& now = back->garments[0];
    REQUIRE(now.mesh.positions.size() == track.mesh.positions.size());
    CHECK(now.mesh.triangles.size() == track.mesh.triangles.size());
    REQUIRE(now.frames.size() == 2);
    CHECK(now.time_s == track.time_s);
    double worst = 0.0;
    for (std::size_t v = 0; v < track.frames[1].size(); ++v)
      worst = std::max(worst, (now.frames[1][v] - track.frames[1][v]).norm());
    CHECK(worst < 1e-6);
  }
  SUBCASE("a point cache has the vertices of the GLB") {
    REQUIRE(io::write_cloth_cache(track, {}, folder / "out.mdd").ok());
    const json document = document_of(folder / "out.glb");
    const json& primitive = document["meshes"][0]["primitives"][0];
    const auto count = document["accessors"][primitive["attributes"]["POSITION"].get<std::size_t>()]["count"]
                           .get<std::size_t>();
    CHECK(count > tube.mesh.positions.size());
    CHECK(std::filesystem::file_size(folder / "out.mdd") == 8 + 2 * 4 + 2 * 12 * count);
  }
  SUBCASE("a GLB as a garment keeps them as well, its materials word for word") {
    const io::ImportedMesh again = imported(folder / "out.glb");
    CHECK(again.warnings.empty());
    written(again, folder / "again.glb");
    check_read_by_assimp(folder / "again.glb", tube);
    for (const char* list : {"materials", "textures", "images"}) {
      json first = document_of(folder / "out.glb")[list], second = document_of(folder / "again.glb")[list];
      for (json& image : first) image.erase("bufferView");
      for (json& image : second) image.erase("bufferView");
      CHECK(first == second);
    }
  }
  SUBCASE("a map of colors replaces them") {
    io::Scene scene;
    scene.garments.push_back(track);
    scene.garments[0].colors.assign(track.mesh.positions.size(), {1.0f, 0.0f, 0.0f});
    REQUIRE(io::write_glb(scene, folder / "map.glb").ok());
    const json document = document_of(folder / "map.glb");
    CHECK_FALSE(document.contains("textures"));
    CHECK(document["meshes"][0]["primitives"][0]["attributes"].contains("COLOR_0"));
  }
  SUBCASE("a look of another mesh is refused") {
    io::Scene scene;
    scene.garments.push_back(track);
    scene.garments[0].mesh.triangles.pop_back();
    CHECK_FALSE(io::write_glb(scene, folder / "wrong.glb").ok());
  }
}

TEST_CASE("what a batch depends on includes an OBJ's library and its images") {
  const TempFolder folder;
  folder.write("tube.mtl", kMtl);
  const auto image = folder.write("pixel one.png", kPng);
  const auto beside = io::files_beside(folder.write("tube.obj", Tube().obj()));
  CHECK(beside == std::vector<std::filesystem::path>{folder / "tube.mtl", image});
}

TEST_CASE("an image that is not there is a warning, and the rest of the look stays") {
  const TempFolder folder;
  const Tube tube;
  folder.write("tube.mtl", kMtl);
  const io::ImportedMesh garment = imported(folder.write("tube.obj", tube.obj()));
  REQUIRE(garment.warnings.size() == 1);
  CHECK(garment.warnings[0].code == "image-left-out");
  CHECK(garment.warnings[0].message.find("pixel one.png") != std::string::npos);
  written(garment, folder / "out.glb");
  const json document = document_of(folder / "out.glb");
  CHECK_FALSE(document.contains("images"));
  CHECK(document["materials"].size() == 2);
}

TEST_CASE("an OBJ without its library has texture coordinates, and no materials that its reader made up") {
  const TempFolder folder;
  const io::ImportedMesh garment = imported(folder.write("tube.obj", Tube().obj()));
  CHECK(garment.warnings.empty());
  written(garment, folder / "out.glb");
  const json document = document_of(folder / "out.glb");
  REQUIRE(document["materials"].size() == 1);
  CHECK(document["materials"][0]["name"] == "cloth");
  CHECK(document["meshes"][0]["primitives"][0]["attributes"].contains("TEXCOORD_0"));
}

TEST_CASE(
    "materials of glTF keep extensions, samplers and images beside the file; images that are not there do "
    "not") {
  const TempFolder folder;
  folder.write("red.png", kPng);
  json document = json::parse(to_gltf(Tube().mesh, kIdentity));
  document["images"] = {{{"uri", "red.png"}}, {{"uri", "missing.png"}}};
  document["samplers"] = {{{"wrapS", 10497}}, {{"wrapS", 33071}, {"name", "clamped"}}};
  document["textures"] = {{{"source", 1}}, {{"source", 0}, {"sampler", 1}}, json::object()};
  document["extensionsUsed"] = {"KHR_materials_sheen", "KHR_texture_transform"};
  const json sheen = {{"sheenColorFactor", {0.9, 0.8, 0.7}}, {"sheenColorTexture", {{"index", 1}}}};
  const json turned = {{"index", 1}, {"extensions", {{"KHR_texture_transform", {{"scale", {2, 2}}}}}}};
  document["materials"] = {{{"name", "unused"}},
                           {{"name", "Velvet"},
                            {"alphaMode", "MASK"},
                            {"pbrMetallicRoughness", {{"baseColorTexture", turned}}},
                            {"normalTexture", {{"index", 0}}},
                            {"occlusionTexture", {{"index", 2}}},
                            {"extensions", {{"KHR_materials_sheen", sheen}}}}};
  document["meshes"][0]["primitives"][0]["material"] = 1;
  const io::ImportedMesh garment = imported(folder.write("a.gltf", document.dump()));
  REQUIRE(garment.warnings.size() == 1);
  CHECK(garment.warnings[0].part == "missing.png");
  written(garment, folder / "out.glb");
  const json out = document_of(folder / "out.glb");
  json velvet = document["materials"][1];
  for (const char* dropped : {"normalTexture", "occlusionTexture"}) velvet.erase(dropped);
  velvet["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 0;
  velvet["extensions"]["KHR_materials_sheen"]["sheenColorTexture"]["index"] = 0;
  CHECK(out["materials"] == json::array({velvet}));
  CHECK(out["textures"] == json::parse(R"([{"source": 0, "sampler": 0}])"));
  CHECK(out["samplers"] == json::array({document["samplers"][1]}));
  CHECK(out["images"].size() == 1);
  CHECK(out["extensionsUsed"] == document["extensionsUsed"]);
  CHECK_FALSE(out.contains("extensionsRequired"));
}

TEST_CASE("a look with any of its values replaced is read, or refused with a sentence") {
  const TempFolder folder;
  folder.write("red.png", kPng);
  json document = json::parse(to_gltf(Tube().mesh, kIdentity));
  document["images"] = {{{"uri", "red.png"}, {"name", "red"}}};
  document["samplers"] = {{{"wrapS", 33071}}};
  document["textures"] = {{{"source", 0}, {"sampler", 0}}};
  document["materials"] = {{{"name", "Velvet"},
                            {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}, {"texCoord", 0}}}}},
                            {"extensions", {{"KHR_materials_sheen", {{"sheenColorFactor", {1, 1, 1}}}}}}}};
  json& primitive = document["meshes"][0]["primitives"][0];
  primitive["material"] = 0;
  primitive["attributes"]["TEXCOORD_0"] = primitive["attributes"]["POSITION"];  // three components, not two
  std::size_t read = 0, refused = 0;
  const auto attempt = [&](const json& changed) {
    const auto garment = io::import_garment(kContext, folder.write("a.gltf", changed.dump()), {});
    if (!garment.ok()) {
      CHECK_FALSE(garment.error().sentence().empty());
      ++refused;
      return;
    }
    written(*garment, folder / "out.glb");
    ++read;
  };
  attempt(document);
  CHECK(read == 1);
  const json flat = document.flatten();
  for (const auto& [pointer, value] : flat.items()) {
    const bool of_look = pointer.find("/images") == 0 || pointer.find("/samplers") == 0 ||
                         pointer.find("/textures") == 0 || pointer.find("/materials") == 0 ||
                         pointer.ends_with("/material") || pointer.ends_with("/TEXCOORD_0");
    if (!of_look) continue;
    for (const json& other :
         {json(), json(-1), json(1'000'000), json(0.5), json("x"), json::array(), json::object()}) {
      json changed = document;
      changed[json::json_pointer(pointer)] = other;
      attempt(changed);
    }
  }
  CHECK(read > 20);
  CHECK(refused > 0);
}
