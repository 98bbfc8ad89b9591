#include "rig.hpp"

#include <cstdint>
#include <cstring>
#include <fstream>
#include <map>

#include <nlohmann/json.hpp>

namespace bench {
namespace {

using bodice::geometry::Index;
using bodice::geometry::TriMesh;
using bodice::geometry::Vec3;
using nlohmann::json;

/// A GLB's JSON and its one buffer.
struct Glb {
  json document;
  std::vector<char> buffer;
};

Glb read_glb(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  Glb glb;
  in.ignore(12);  // magic, version, length
  for (int chunk = 0; chunk < 2; ++chunk) {
    std::uint32_t head[2] = {};  // length, kind
    in.read(reinterpret_cast<char*>(head), sizeof head);
    std::vector<char> bytes(head[0]);
    in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (chunk == 0)
      glb.document = json::parse(bytes.begin(), bytes.end());
    else
      glb.buffer = std::move(bytes);
  }
  return glb;
}

constexpr int kByte = 5121, kShort = 5123, kFloat = 5126;

/// Element i of an accessor, as `count` numbers.
struct Accessor {
  const char* data;
  std::size_t stride, size;
  int type;

  double operator()(std::size_t i, std::size_t k) const {
    const char* at = data + i * stride + k * size;
    const auto as = [at](auto value) {
      std::memcpy(&value, at, sizeof value);
      return static_cast<double>(value);
    };
    if (type == kByte) return as(std::uint8_t{});
    if (type == kShort) return as(std::uint16_t{});
    return type == kFloat ? as(float{}) : as(std::uint32_t{});
  }
};

Accessor accessor(const Glb& glb, const json& index) {
  const json& a = glb.document["accessors"][index.get<std::size_t>()];
  const json& view = glb.document["bufferViews"][a["bufferView"].get<std::size_t>()];
  const int type = a["componentType"];
  const std::size_t size = type == kByte ? 1 : type == kShort ? 2 : 4;
  const std::map<std::string, std::size_t> width{{"SCALAR", 1}, {"VEC3", 3}, {"VEC4", 4}};
  const std::size_t packed = size * width.at(a["type"].get<std::string>());
  const std::size_t from = view.value("byteOffset", std::size_t{0}) + a.value("byteOffset", std::size_t{0});
  return {glb.buffer.data() + from, view.value("byteStride", packed), size, type};
}

std::vector<Bone> read_bones(const json& nodes, std::size_t node, int parent, const Vec3& origin,
                             std::vector<Bone> bones, std::map<std::size_t, std::size_t>& bone_of_node) {
  const json& n = nodes[node];
  Bone bone{n.value("name", ""), parent, origin};
  if (n.contains("translation"))
    for (int k = 0; k < 3; ++k) bone.head[k] += n["translation"][static_cast<std::size_t>(k)].get<double>();
  const auto self = static_cast<int>(bones.size());
  bone_of_node[node] = bones.size();
  bones.push_back(bone);
  if (n.contains("children"))
    for (const json& child : n["children"])
      bones = read_bones(nodes, child.get<std::size_t>(), self, bone.head, std::move(bones), bone_of_node);
  return bones;
}

void read_skin(const Glb& glb, const json& primitive, Rig& rig) {
  const json &attributes = primitive["attributes"], &accessors = glb.document["accessors"];
  const Accessor position = accessor(glb, attributes["POSITION"]);
  const Accessor joints = accessor(glb, attributes["JOINTS_0"]),
                 weights = accessor(glb, attributes["WEIGHTS_0"]);
  const Accessor corner = accessor(glb, primitive["indices"]);
  const json& skin = glb.document["skins"][0];
  std::map<std::size_t, std::size_t> bone_of_node;
  rig.bones = read_bones(glb.document["nodes"], skin["joints"][0].get<std::size_t>(), -1, Vec3::Zero(), {},
                         bone_of_node);
  const auto vertices = accessors[attributes["POSITION"].get<std::size_t>()]["count"].get<std::size_t>();
  for (std::size_t v = 0; v < vertices; ++v) {
    rig.rest.positions.emplace_back(position(v, 0), position(v, 1), position(v, 2));
    Influence influence{};
    for (std::size_t k = 0; k < 4; ++k) {
      const auto joint = static_cast<std::size_t>(joints(v, k));
      influence.bone[k] = bone_of_node.at(skin["joints"][joint].get<std::size_t>());
      influence.weight[k] = weights(v, k);
    }
    rig.influences.push_back(influence);
  }
  const auto corners = accessors[primitive["indices"].get<std::size_t>()]["count"].get<std::size_t>();
  const auto at = [&](std::size_t i) { return static_cast<Index>(corner(i, 0)); };
  for (std::size_t i = 0; i + 2 < corners; i += 3)
    rig.rest.triangles.push_back({at(i), at(i + 1), at(i + 2)});
}

/// How much of a vertex follows the bone.
double share_of(const Influence& influence, std::size_t bone) {
  double share = 0.0;
  for (std::size_t k = 0; k < 4; ++k) share += influence.bone[k] == bone ? influence.weight[k] : 0.0;
  return share;
}

}  // namespace

Rig read_rig(const std::filesystem::path& glb_file) {
  const Glb glb = read_glb(glb_file);
  Rig rig;
  for (const json& mesh : glb.document["meshes"])
    if (mesh.value("name", "") == "body") read_skin(glb, mesh["primitives"][0], rig);
  return rig;
}

Rig moved_into(const Rig& rig, const TriMesh& rest) {
  Rig moved = rig;
  moved.rest.positions = rest.positions;
  for (std::size_t b = 0; b < rig.bones.size(); ++b) {
    const int parent = rig.bones[b].parent;
    Vec3 shift = Vec3::Zero();
    double all = 0.0;
    for (std::size_t v = 0; v < rest.positions.size(); ++v) {
      const double own = share_of(rig.influences[v], b);
      const double shared =
          parent < 0 ? own : own * share_of(rig.influences[v], static_cast<std::size_t>(parent));
      shift += shared * (rest.positions[v] - rig.rest.positions[v]);
      all += shared;
    }
    if (all > 0.0)
      moved.bones[b].head += shift / all;
    else if (parent >= 0)
      moved.bones[b].head += moved.bones[static_cast<std::size_t>(parent)].head -
                             rig.bones[static_cast<std::size_t>(parent)].head;
  }
  return moved;
}

std::vector<Eigen::Affine3d> pose_bones(const Rig& rig, const std::vector<Eigen::Quaterniond>& turns) {
  std::vector<Eigen::Affine3d> pose(rig.bones.size());
  for (std::size_t b = 0; b < pose.size(); ++b) {
    const Bone& bone = rig.bones[b];
    const Eigen::Affine3d about_head =
        Eigen::Translation3d(bone.head) * turns[b] * Eigen::Translation3d(-bone.head);
    pose[b] = bone.parent < 0 ? about_head : pose[static_cast<std::size_t>(bone.parent)] * about_head;
  }
  return pose;
}

TriMesh pose_skin(const Rig& rig, const std::vector<Eigen::Affine3d>& bones) {
  TriMesh posed = rig.rest;
  for (std::size_t v = 0; v < posed.positions.size(); ++v) {
    const Influence& influence = rig.influences[v];
    Vec3 sum = Vec3::Zero();
    double all = 0.0;
    for (std::size_t k = 0; k < 4; ++k) {
      sum += influence.weight[k] * (bones[influence.bone[k]] * rig.rest.positions[v]);
      all += influence.weight[k];
    }
    if (all > 0.0) posed.positions[v] = sum / all;
  }
  return posed;
}

}  // namespace bench
