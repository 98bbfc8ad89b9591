#include <doctest/doctest.h>

#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>

#include <assimp/scene.h>
#include <assimp/Importer.hpp>
#include <bodice/geometry/ellipsoid.hpp>
#include <bodice_test/temp_folder.hpp>
#include <nlohmann/json.hpp>

#include "scene_fixture.hpp"

using namespace bodice;
using namespace io_test;
using bodice_test::TempFolder;
using nlohmann::json;

namespace {

/// A GLB file taken apart as the specification describes it.
struct FileParts {
  json document;
  std::string buffer;
};

std::uint32_t checked_word(const std::string& bytes, std::size_t at) {
  REQUIRE(at + 4 <= bytes.size());
  std::uint32_t value;
  std::memcpy(&value, bytes.data() + at, 4);
  return value;
}

FileParts open(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  CHECK(checked_word(bytes, 0) == 0x46546C67);
  CHECK(checked_word(bytes, 4) == 2);
  CHECK(checked_word(bytes, 8) == bytes.size());
  const std::size_t text = checked_word(bytes, 12);
  CHECK(text % 4 == 0);
  CHECK(checked_word(bytes, 16) == 0x4E4F534A);
  const std::size_t data = checked_word(bytes, 20 + text);
  CHECK(data % 4 == 0);
  CHECK(checked_word(bytes, 24 + text) == 0x004E4942);
  REQUIRE(28 + text + data == bytes.size());
  return {json::parse(bytes.substr(20, text)), bytes.substr(28 + text)};
}

std::vector<float> floats(const FileParts& glb, std::size_t accessor) {
  const json& a = glb.document["accessors"][accessor];
  const json& view = glb.document["bufferViews"][a["bufferView"].get<std::size_t>()];
  REQUIRE(a["componentType"] == 5126);
  std::vector<float> values(a["count"].get<std::size_t>() * (a["type"] == "VEC3" ? 3 : 1));
  REQUIRE(values.size() * 4 == view["byteLength"].get<std::size_t>());
  std::memcpy(values.data(), glb.buffer.data() + view["byteOffset"].get<std::size_t>(), values.size() * 4);
  return values;
}

const json& node(const FileParts& glb, std::string_view name) {
  for (const json& n : glb.document["nodes"])
    if (n.value("name", "") == name) return n;
  FAIL("no node " << name);
  return glb.document;
}

const json& primitive(const FileParts& glb, std::string_view node_name) {
  return glb.document["meshes"][node(glb, node_name)["mesh"].get<std::size_t>()]["primitives"][0];
}

/// Checks alignment, extents and bounds of every accessor.
void check_accessors(const FileParts& glb) {
  CHECK(glb.document["buffers"][0]["byteLength"] == glb.buffer.size());
  for (const json& view : glb.document["bufferViews"]) {
    CHECK(view["byteOffset"].get<std::size_t>() % 4 == 0);
    CHECK(view["byteOffset"].get<std::size_t>() + view["byteLength"].get<std::size_t>() <= glb.buffer.size());
    CHECK(view["byteLength"].get<std::size_t>() > 0);
  }
  for (std::size_t a = 0; a < glb.document["accessors"].size(); ++a) {
    const json& accessor = glb.document["accessors"][a];
    if (!accessor.contains("min")) continue;
    const std::vector<float> values = floats(glb, a);
    const std::size_t width = accessor["min"].size();
    for (std::size_t k = 0; k < width; ++k) {
      float low = std::numeric_limits<float>::infinity(), high = -low;
      for (std::size_t i = k; i < values.size(); i += width)
        low = std::min(low, values[i]), high = std::max(high, values[i]);
      CHECK(accessor["min"][k].get<float>() == low);
      CHECK(accessor["max"][k].get<float>() == high);
    }
  }
}

void check_unit_normals(const FileParts& glb, std::string_view node_name) {
  const std::vector<float> n =
      floats(glb, primitive(glb, node_name)["attributes"]["NORMAL"].get<std::size_t>());
  for (std::size_t i = 0; i < n.size(); i += 3)
    CHECK(n[i] * n[i] + n[i + 1] * n[i + 1] + n[i + 2] * n[i + 2] == doctest::Approx(1.0).epsilon(1e-5));
}

FileParts written(const io::Scene& scene, const TempFolder& folder) {
  const auto result = io::write_glb(scene, folder / "scene.glb");
  REQUIRE_MESSAGE(result.ok(), (result.ok() ? std::string() : result.error().sentence()));
  return open(folder / "scene.glb");
}

}  // namespace

TEST_CASE("the GLB obeys the rules of the format, and has its named nodes as roots") {
  const TempFolder folder;
  const SceneFixture fixture;
  const FileParts glb = written(fixture.scene, folder);
  check_accessors(glb);
  for (const char* name : {"body", "cloth"}) check_unit_normals(glb, name);
  std::vector<std::string> roots;
  for (const json& index : glb.document["scenes"][0]["nodes"])
    roots.push_back(glb.document["nodes"][index.get<std::size_t>()]["name"]);
  CHECK(roots == std::vector<std::string>{"body", "ellipsoids", "cloth"});
  CHECK(node(glb, "ellipsoids")["children"].size() == fixture.scene.proxy->ellipsoids().size());
  CHECK(primitive(glb, "body")["attributes"].contains("COLOR_0"));
}

TEST_CASE("positions and ellipsoids are in the input's units and axes") {
  const TempFolder folder;
  const geometry::Frame frame{.meters_per_unit = 0.01, .up = geometry::Axis::kZ};
  const SceneFixture fixture(frame);
  const FileParts glb = written(fixture.scene, folder);
  const std::vector<float> p =
      floats(glb, primitive(glb, "body")["attributes"]["POSITION"].get<std::size_t>());
  for (std::size_t v = 0; v < fixture.body.positions.size(); ++v) {
    const Vec3 truth = frame.to_file(fixture.body.positions[v]);
    for (std::size_t k = 0; k < 3; ++k)
      CHECK(static_cast<double>(p[3 * v + k]) == doctest::Approx(truth[static_cast<int>(k)]).epsilon(1e-5));
  }
  // The node takes each point of the unit sphere to the ellipsoid.
  const auto& shape = fixture.scene.proxy->ellipsoids()[0].shape;
  const json& placed = glb.document["nodes"][node(glb, "ellipsoids")["children"][0].get<std::size_t>()];
  auto triple = [](const json& j) { return Vec3(j[0], j[1], j[2]); };
  const json& q = placed["rotation"];
  const Eigen::Quaterniond turn(q[3].get<double>(), q[0], q[1], q[2]);
  for (const Vec3& u : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(0.6, 0, -0.8)}) {
    const Vec3 file = triple(placed["translation"]) + turn * triple(placed["scale"]).cwiseProduct(u);
    CHECK(level(shape, frame.to_inside(file)) == doctest::Approx(1.0).epsilon(1e-9));
  }
}

TEST_CASE("at the time of each kept frame the weight of its morph target is one and all others are zero") {
  const TempFolder folder;
  const SceneFixture fixture;
  const FileParts glb = written(fixture.scene, folder);
  const io::GarmentTrack& track = fixture.scene.garments[0];
  const json& cloth = primitive(glb, "cloth");
  REQUIRE(cloth["targets"].size() == track.frames.size());
  const std::vector<float> base = floats(glb, cloth["attributes"]["POSITION"].get<std::size_t>());
  for (std::size_t f = 0; f < track.frames.size(); ++f) {
    const std::vector<float> delta = floats(glb, cloth["targets"][f]["POSITION"].get<std::size_t>());
    double worst = 0.0;
    for (std::size_t i = 0; i < base.size(); ++i)
      worst = std::max(worst, std::abs(static_cast<double>(base[i] + delta[i]) -
                                       track.frames[f][i / 3][static_cast<int>(i % 3)]));
    CHECK(worst < 1e-6);
    CHECK(cloth["targets"][f].contains("NORMAL"));
  }
  const json& sampler = glb.document["animations"][0]["samplers"][0];
  CHECK(sampler["interpolation"] == "LINEAR");
  CHECK(floats(glb, sampler["input"].get<std::size_t>()) == std::vector<float>{0.0f, 0.5f, 1.0f});
  CHECK(floats(glb, sampler["output"].get<std::size_t>()) == std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1});
}

TEST_CASE("frames of a single time make no animation, and times that go back are refused") {
  const TempFolder folder;
  SceneFixture fixture;
  io::GarmentTrack& track = fixture.scene.garments[0];
  track.time_s.assign(track.frames.size(), 0.25);
  const FileParts glb = written(fixture.scene, folder);
  CHECK_FALSE(glb.document.contains("animations"));
  CHECK(primitive(glb, "cloth")["targets"].size() == track.frames.size());
  track.time_s[1] = 0.5;  // time goes back
  CHECK_FALSE(io::write_glb(fixture.scene, folder / "again.glb").ok());
}

TEST_CASE("assimp reads the GLB back with the same counts") {
  const TempFolder folder;
  const SceneFixture fixture;
  written(fixture.scene, folder);
  Assimp::Importer importer;
  const aiScene* read = importer.ReadFile((folder / "scene.glb").string(), 0);
  REQUIRE(read);
  const aiNode* body = read->mRootNode->FindNode("body");
  REQUIRE(body);
  REQUIRE(body->mNumMeshes == 1);
  CHECK(read->mMeshes[body->mMeshes[0]]->mNumVertices == fixture.body.positions.size());
  CHECK(read->mMeshes[body->mMeshes[0]]->mNumFaces == fixture.body.triangles.size());
  const aiNode* cloth = read->mRootNode->FindNode("cloth");
  REQUIRE(cloth);
  CHECK(read->mMeshes[cloth->mMeshes[0]]->mNumAnimMeshes == fixture.scene.garments[0].frames.size());
}

TEST_CASE("a scene far from the origin keeps its digits in the node's translation") {
  const TempFolder folder;
  SceneFixture fixture;
  const Vec3 far(10'000.0, 20.0, -5'000.0);
  for (Vec3& p : fixture.body.positions) p += far;
  fixture.scene.proxy = nullptr;
  fixture.scene.garments.clear();
  const FileParts glb = written(fixture.scene, folder);
  const json& t = node(glb, "body")["translation"];
  const std::vector<float> p =
      floats(glb, primitive(glb, "body")["attributes"]["POSITION"].get<std::size_t>());
  double worst = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i)
    worst = std::max(worst, std::abs(t[i % 3].get<double>() + static_cast<double>(p[i]) -
                                     fixture.body.positions[i / 3][static_cast<int>(i % 3)]));
  CHECK(worst < 1e-6);
}

TEST_CASE("a scene that cannot be drawn is refused and leaves no file") {
  const TempFolder folder;
  auto refused = [&](const io::Scene& scene) {
    const auto glb = io::write_glb(scene, folder / "scene.glb");
    const auto png = io::write_picture(scene, {}, folder / "scene.png");
    CHECK(!std::filesystem::exists(folder / "scene.glb"));
    CHECK(!std::filesystem::exists(folder / "scene.png"));
    return !glb.ok() && !png.ok() && glb.error().code == engine::ErrorCode::kInvalidArgument;
  };
  CHECK(refused({}));
  SceneFixture nan, short_frame, parts, index;
  nan.body.positions[3].y() = std::numeric_limits<double>::quiet_NaN();
  CHECK(refused(nan.scene));
  short_frame.scene.garments[0].frames[1].pop_back();
  CHECK(refused(short_frame.scene));
  parts.scene.part = std::span(parts.part).first(5);
  CHECK(refused(parts.scene));
  index.body.triangles[0][2] = 1'000'000;
  CHECK(refused(index.scene));
}

TEST_CASE("the GLB's ellipsoids move with their proxy at the times of the garments") {
  const TempFolder folder;
  SceneFixture fixture;
  std::vector<std::vector<geometry::Ellipsoid>> frames(3);
  for (std::size_t f = 0; f < 3; ++f)
    for (const proxy::ProxyEllipsoid& e : fixture.proxies.front().ellipsoids()) {
      frames[f].push_back(e.shape);
      frames[f].back().center.x() += 0.125 * static_cast<double>(f);
    }
  // The same ellipsoid with its first two axes in the other order: its node does not turn.
  geometry::Ellipsoid& swapped = frames[1][0];
  std::swap(swapped.radii.x(), swapped.radii.y());
  const Vec3 first = swapped.axes.col(0);
  swapped.axes.col(0) = swapped.axes.col(1);
  swapped.axes.col(1) = -first;
  fixture.scene.proxy_frames = frames;
  const FileParts glb = written(fixture.scene, folder);
  check_accessors(glb);
  const std::size_t moved = node(glb, "ellipsoids")["children"][0].get<std::size_t>();
  const json& animation = glb.document["animations"][0];
  int found = 0;
  for (const json& channel : animation["channels"]) {
    if (channel["target"]["node"] != moved) continue;
    const json& sampler = animation["samplers"][channel["sampler"].get<std::size_t>()];
    CHECK(floats(glb, sampler["input"].get<std::size_t>()) == std::vector<float>{0.0f, 0.5f, 1.0f});
    ++found;
    const std::string path = channel["target"]["path"];
    if (path == "rotation") continue;  // four numbers each
    const std::vector<float> values = floats(glb, sampler["output"].get<std::size_t>());
    REQUIRE(values.size() == 9);
    if (path == "translation") CHECK(values[6] == doctest::Approx(values[0] + 0.25f));
    if (path == "scale") CHECK(values[3] == doctest::Approx(values[0]));
  }
  CHECK(found == 3);

  fixture.scene.proxy_frames = std::span(frames).first(2);
  const auto refused = io::write_glb(fixture.scene, folder / "short.glb");
  REQUIRE_FALSE(refused.ok());
  CHECK(refused.error().sentence().find("2 frames") != std::string::npos);
}

TEST_CASE("the colors of a garment are in the GLB in linear light, and its material is white") {
  SceneFixture fixture;
  io::GarmentTrack& track = fixture.scene.garments[0];
  track.colors.assign(track.mesh.positions.size(), {1.0f, 0.5f, 0.0f});
  const TempFolder folder;
  REQUIRE(io::write_glb(fixture.scene, folder / "map.glb").ok());
  const FileParts glb = open(folder / "map.glb");
  check_accessors(glb);
  const json& cloth = primitive(glb, "cloth");
  const std::vector<float> colors = floats(glb, cloth["attributes"]["COLOR_0"].get<std::size_t>());
  REQUIRE(colors.size() == 3 * track.mesh.positions.size());
  CHECK(colors[0] == 1.0f);
  CHECK(double{colors[1]} == doctest::Approx(0.2140).epsilon(0.001));
  CHECK(colors[2] == 0.0f);
  const json& material = glb.document["materials"][cloth["material"].get<std::size_t>()];
  CHECK(material["pbrMetallicRoughness"]["baseColorFactor"] == json({1.0, 1.0, 1.0, 1.0}));
  track.colors.pop_back();
  CHECK(!io::write_glb(fixture.scene, folder / "few.glb").ok());
}
