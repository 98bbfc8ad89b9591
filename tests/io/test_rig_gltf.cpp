// Rigs in glTF as other programs write them, good and bad: a written GLB with its document changed.
#include <doctest/doctest.h>

#include <cstring>
#include <fstream>
#include <functional>
#include <iterator>

#include <bodice/io/rig.hpp>
#include <bodice_test/temp_folder.hpp>
#include <nlohmann/json.hpp>

#include "made_rig.hpp"

using namespace bodice;
using namespace io_test;
using bodice_test::TempFolder;
using nlohmann::json;

namespace {

/// A GLB taken apart, to be changed.
struct Glb {
  json document;
  std::string buffer;

  json& accessor(std::size_t k) { return document["accessors"][k]; }
  /// Adds an accessor over bytes at the buffer's end.
  std::size_t add(const std::string& bytes, int component, std::size_t count, const char* type) {
    document["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", buffer.size()}, {"byteLength", bytes.size()}});
    buffer += bytes;
    buffer.resize((buffer.size() + 3) / 4 * 4);
    document["accessors"].push_back({{"bufferView", document["bufferViews"].size() - 1},
                                     {"componentType", component},
                                     {"count", count},
                                     {"type", type}});
    return document["accessors"].size() - 1;
  }
  std::vector<float> floats(std::size_t k) {
    const json& view = document["bufferViews"][accessor(k)["bufferView"].get<std::size_t>()];
    std::vector<float> values(view["byteLength"].get<std::size_t>() / 4);
    std::memcpy(values.data(), buffer.data() + view["byteOffset"].get<std::size_t>(), 4 * values.size());
    return values;
  }
};

std::uint32_t word(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, 4);
  return value;
}

std::string words(std::initializer_list<std::size_t> values) {
  std::string bytes;
  for (const std::size_t value : values) {
    const auto narrow = static_cast<std::uint32_t>(value);
    bytes.append(reinterpret_cast<const char*>(&narrow), 4);
  }
  return bytes;
}

std::filesystem::path changed(const TempFolder& folder, const char* name,
                              const std::function<void(Glb&)>& change) {
  const TriMesh skin = figure();
  const auto written = folder / "written.glb";
  REQUIRE(io::write_rigged_glb(skin, made_rig(skin), written).ok());
  std::ifstream stream(written, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  const std::size_t text = word(bytes, 12);
  Glb glb{json::parse(bytes.substr(20, text)), bytes.substr(28 + text)};
  change(glb);
  glb.document["buffers"][0]["byteLength"] = glb.buffer.size();
  std::string document = glb.document.dump();
  document.resize((document.size() + 3) / 4 * 4, ' ');
  return folder.write(name, words({0x46546C67, 2, 28 + document.size() + glb.buffer.size()}) +
                                words({document.size(), 0x4E4F534A}) + document +
                                words({glb.buffer.size(), 0x004E4942}) + glb.buffer);
}

io::RiggedBody import_changed(const TempFolder& folder, const std::function<void(Glb&)>& change,
                              const io::ImportOptions& options = {}) {
  auto body = io::import_rigged_body({}, changed(folder, "changed.glb", change), options);
  REQUIRE(body.ok());
  return std::move(*body);
}

/// The largest distance between vertices of a body that was read and posed by its clip and those of the
/// written rig, posed likewise and mapped.
double farthest(const io::RiggedBody& body, double time_s, const rig::Affine& map = rig::identity()) {
  const TriMesh skin = figure();
  const rig::Rig made = made_rig(skin);
  REQUIRE(body.rig.ok());
  REQUIRE(body.rig->clips.size() == 2);
  const auto now = posed(body.body.skin, *body.rig, body.rig->clips[0], time_s);
  const auto then = posed(skin, made, made.clips[0], time_s);
  double worst = 0.0;
  for (std::size_t i = 0; i < then.size(); ++i)
    worst = std::max(worst, (now.at(body.body.vertex_of_input.at(i)) - rig::apply(map, then[i])).norm());
  return worst;
}

constexpr double kFloats_m = 5e-6;

void check_refused(const std::filesystem::path& file, const char* words_of_flaw) {
  CAPTURE(words_of_flaw);
  const auto body = io::import_rigged_body({}, file);
  const engine::Error error = !body ? body.error() : !body->rig ? body->rig.error() : engine::Error{};
  CHECK(error.message.find(file.string()) != std::string::npos);
  CHECK(error.message.find(words_of_flaw) != std::string::npos);
  CHECK(error.message.ends_with('.'));
  CHECK(!error.remedy.empty());
}

json& attributes(Glb& glb) {
  return glb.document["meshes"][0]["primitives"][0]["attributes"];
}

}  // namespace

TEST_CASE("a rig's joints are found though all have one name, or none") {
  const TempFolder folder;
  for (const bool named : {true, false}) {
    const io::RiggedBody body = import_changed(folder, [&](Glb& glb) {
      for (json& node : glb.document["nodes"])
        if (named)
          node["name"] = "bone";
        else
          node.erase("name");
    });
    CHECK(farthest(body, 0.8) < kFloats_m);
  }
}

TEST_CASE("a rig in a file of centimeters, z up, moves the turned and scaled skin alike") {
  const TempFolder folder;
  io::ImportOptions options;
  options.unit = io::Unit::kDecimeter;
  options.up = geometry::Axis::kZ;
  const io::RiggedBody body = import_changed(
      folder, [](Glb&) {}, options);
  const geometry::Frame frame{0.1, geometry::Axis::kZ};
  for (const double time : {0.0, 0.8, 1.5})
    CHECK(farthest(body, time, rig::affine(0.1 * frame.rotation(), Vec3::Zero())) < kFloats_m);
  for (const rig::Joint& joint : body.rig->skeleton.joints)
    if (joint.parent < 0)
      CHECK((joint.local.scale - Vec3::Ones()).norm() < 1e-6);  // lengths are meters, not scaled units
}

TEST_CASE("nodes above and between joints count, with shear and uneven scales") {
  const TempFolder folder;
  rig::Affine above;
  above << 0.9, 0.3, 0, 0.2, 0, 1.1, 0, 0.1, 0.2, 0, 1, -0.3;
  const io::RiggedBody body = import_changed(folder, [&](Glb& glb) {
    Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
    matrix.topRows<3>() = above;
    const std::size_t root = glb.document["skins"][0]["skeleton"].get<std::size_t>();
    glb.document["nodes"].push_back({{"name", "stage"}, {"children", {root}}});
    glb.document["nodes"].back()["matrix"] = std::vector<double>(matrix.data(), matrix.data() + 16);
    for (json& node : glb.document["scenes"][0]["nodes"])
      if (node == root) node = glb.document["nodes"].size() - 1;
  });
  // Posed points are moved by the node; the skin itself may be stored anywhere.
  CHECK(farthest(body, 0.8, above) < kFloats_m);
  CHECK(find_joint(body.rig->skeleton, "stage").has_value());
}

TEST_CASE("weights in normalized 16-bit numbers are weights") {
  const TempFolder folder;
  const io::RiggedBody body = import_changed(folder, [&](Glb& glb) {
    for (const char* set : {"WEIGHTS_0", "WEIGHTS_1"}) {
      const std::vector<float> values = glb.floats(attributes(glb)[set].get<std::size_t>());
      std::string bytes;
      for (const float value : values) {
        const auto rounded = static_cast<std::uint16_t>(std::lround(65535.0 * static_cast<double>(value)));
        bytes.append(reinterpret_cast<const char*>(&rounded), 2);
      }
      const std::size_t at = glb.add(bytes, 5123, values.size() / 4, "VEC4");
      glb.accessor(at)["normalized"] = true;
      attributes(glb)[set] = at;
    }
  });
  CHECK(farthest(body, 0.8) < 1e-4);  // 16 bits keep 1.5e-5 of a meter or two
}

TEST_CASE("vertices without weights follow a neighbor, and a warning counts them") {
  const TempFolder folder;
  const io::RiggedBody body = import_changed(folder, [&](Glb& glb) {
    for (const char* set : {"WEIGHTS_0", "WEIGHTS_1"}) {
      std::vector<float> values = glb.floats(attributes(glb)[set].get<std::size_t>());
      std::fill_n(values.begin(), 4 * 7, 0.0f);
      const std::string bytes(reinterpret_cast<const char*>(values.data()), 4 * values.size());
      attributes(glb)[set] = glb.add(bytes, 5126, values.size() / 4, "VEC4");
    }
  });
  REQUIRE(body.rig.ok());
  bool warned = false;
  for (const engine::Warning& warning : body.body.warnings)
    warned = warned || (warning.code == "weights-missing" && warning.message.starts_with("7 of 642"));
  CHECK(warned);
}

TEST_CASE("bad rigs are refused in one sentence that names the element") {
  const TempFolder folder;
  const auto refused = [&](const char* flaw, const std::function<void(Glb&)>& change) {
    check_refused(changed(folder, "bad.glb", change), flaw);
  };
  refused("lacks inverse bind matrices",
          [](Glb& glb) { glb.document["skins"][0].erase("inverseBindMatrices"); });
  refused("lacks inverse bind matrices", [](Glb& glb) {
    glb.accessor(glb.document["skins"][0]["inverseBindMatrices"].get<std::size_t>())["count"] = 2;
  });
  refused("Bone 'middle' has no usable inverse bind matrix", [](Glb& glb) {
    std::vector<float> values =
        glb.floats(glb.document["skins"][0]["inverseBindMatrices"].get<std::size_t>());
    std::fill_n(values.begin() + 32, 16, 0.0f);
    const std::string bytes(reinterpret_cast<const char*>(values.data()), 4 * values.size());
    glb.document["skins"][0]["inverseBindMatrices"] = glb.add(bytes, 5126, values.size() / 16, "MAT4");
  });
  refused("has skin weights that are not there for each vertex",
          [](Glb& glb) { attributes(glb)["JOINTS_0"] = attributes(glb)["POSITION"]; });
  refused("has keys without values", [](Glb& glb) {
    json& sampler = glb.document["animations"][0]["samplers"][0];
    sampler["output"] = sampler["input"];
  });
  refused("('low') is scaled to zero", [](Glb& glb) {
    for (json& node : glb.document["nodes"])
      if (node["name"] == "low") node["scale"] = {0, 1, 1};
  });
  refused("recursive", [](Glb& glb) {
    const json joints = glb.document["skins"][0]["joints"];
    glb.document["nodes"][joints[4].get<std::size_t>()]["children"] = {joints[0]};
  });
  refused("not bound to a skeleton", [](Glb& glb) {
    for (json& node : glb.document["nodes"]) node.erase("skin");
    glb.document.erase("skins");
  });
}

TEST_CASE("a clip with a key that is not finite is left out with a warning, the others stay") {
  const TempFolder folder;
  const io::RiggedBody body = import_changed(folder, [](Glb& glb) {
    json& sampler = glb.document["animations"][0]["samplers"][0];
    std::vector<float> values = glb.floats(sampler["output"].get<std::size_t>());
    values[4] = std::numeric_limits<float>::quiet_NaN();
    const std::string bytes(reinterpret_cast<const char*>(values.data()), 4 * values.size());
    sampler["output"] = glb.add(bytes, 5126, values.size() / 3, "VEC3");
  });
  REQUIRE(body.rig.ok());
  REQUIRE(body.rig->clips.size() == 1);
  CHECK(body.rig->clips[0].name == "one key");
  CHECK(body.body.warnings.back().message.find("'all kinds' was left out") != std::string::npos);
}
