// Convex pieces as glTF and OBJ.
#include <bit>
#include <cstring>
#include <map>
#include <string>

#include <bodice/colliders/convex_pieces.hpp>
#include <bodice/engine/base64.hpp>
#include <bodice/engine/json.hpp>
#include <bodice/engine/text.hpp>

#include "bone_frame.hpp"

namespace bodice::inline v0_1::colliders {
namespace {

using engine::Json;

static_assert(std::endian::native == std::endian::little,
              "glTF is little-endian: swap bytes on this machine");

constexpr int kFloat = 5126, kUnsignedShort = 5123, kArrayBuffer = 34962, kElementArrayBuffer = 34963;

/// Appends data to the buffer of a document, and a view of them; returns the view.
std::size_t add_view(const void* data, std::size_t bytes, int target, std::string& buffer, Json& file) {
  file["bufferViews"].push_back(
      {{"buffer", 0}, {"byteOffset", buffer.size()}, {"byteLength", bytes}, {"target", target}});
  buffer.append(static_cast<const char*>(data), bytes);
  buffer.resize((buffer.size() + 3) / 4 * 4);
  return file["bufferViews"].size() - 1;
}

/// Adds the mesh of a piece in the coordinates of its bone; returns its primitive.
Json add_primitive(const ConvexPiece& piece, const BoneFrame& frame, std::string& buffer, Json& file) {
  std::vector<float> positions;
  Eigen::Vector3f low = Eigen::Vector3f::Constant(1e30f), high = -low;
  for (const Vec3& p : piece.mesh.positions) {
    const Eigen::Vector3f local = frame.to_local(p).cast<float>();
    low = low.cwiseMin(local), high = high.cwiseMax(local);
    positions.insert(positions.end(), local.data(), local.data() + 3);
  }
  std::vector<std::uint16_t> indices;
  for (const geometry::Triangle& t : piece.mesh.triangles)
    for (const geometry::Index v : t) indices.push_back(static_cast<std::uint16_t>(v));
  file["accessors"].push_back(
      {{"bufferView", add_view(positions.data(), 4 * positions.size(), kArrayBuffer, buffer, file)},
       {"componentType", kFloat},
       {"count", piece.mesh.positions.size()},
       {"type", "VEC3"},
       {"min", {low.x(), low.y(), low.z()}},
       {"max", {high.x(), high.y(), high.z()}}});
  file["accessors"].push_back(
      {{"bufferView", add_view(indices.data(), 2 * indices.size(), kElementArrayBuffer, buffer, file)},
       {"componentType", kUnsignedShort},
       {"count", indices.size()},
       {"type", "SCALAR"}});
  return {{"attributes", {{"POSITION", file["accessors"].size() - 2}}},
          {"indices", file["accessors"].size() - 1}};
}

Json columns_of(const proxy::JointMatrix& m) {
  Json values = Json::array();
  for (int c = 0; c < 4; ++c) {
    for (int r = 0; r < 3; ++r) values.push_back(m(r, c) + 0.0);
    values.push_back(c == 3 ? 1 : 0);
  }
  return values;
}

/// Names of pieces: the part, and a number.
std::vector<std::string> names_of(std::span<const ConvexPiece> pieces) {
  std::map<body::Part, int> count;
  std::vector<std::string> names;
  for (const ConvexPiece& piece : pieces)
    names.push_back(std::string(body::name(piece.part)) + "_" + std::to_string(count[piece.part]++));
  return names;
}

}  // namespace

std::string convex_gltf(const proxy::BodyProxy& proxy, std::span<const ConvexPiece> pieces) {
  Json file = {{"asset", {{"version", "2.0"}, {"generator", "bodice"}}}, {"scene", 0}};
  for (const char* list : {"bufferViews", "accessors", "meshes"}) file[list] = Json::array();
  Json roots = Json::array(), nodes = Json::array();
  std::string buffer;
  const std::vector<std::string> names = names_of(pieces);
  for (const std::int16_t bone : bones_of(pieces)) {
    const BoneFrame frame = frame_of(proxy, bone);
    Json children = Json::array();
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      if (pieces[i].bone != bone) continue;
      file["meshes"].push_back(
          {{"name", names[i]}, {"primitives", Json::array({add_primitive(pieces[i], frame, buffer, file)})}});
      Json extras = {{"part", body::name(pieces[i].part)}};
      if (!frame.name.empty()) extras["bone"] = frame.name;
      extras["hash"] = engine::hex64(proxy.hash());
      children.push_back(nodes.size());
      nodes.push_back({{"name", names[i]}, {"mesh", file["meshes"].size() - 1}, {"extras", extras}});
    }
    if (frame.name.empty()) {
      for (const Json& child : children) roots.push_back(child);
    } else {
      roots.push_back(nodes.size());
      nodes.push_back({{"name", frame.name}, {"matrix", columns_of(frame.to_skin)}, {"children", children}});
    }
  }
  file["scenes"] = Json::array({Json{{"nodes", roots}}});
  file["nodes"] = nodes;
  file["buffers"] = Json::array({Json{
      {"byteLength", buffer.size()},
      {"uri", "data:application/octet-stream;base64," + engine::base64(std::as_bytes(std::span(buffer)))}}});
  return file.dump({.indent = 1, .replaces_invalid = true}) + "\n";
}

std::string convex_obj(const proxy::BodyProxy& proxy, std::span<const ConvexPiece> pieces) {
  std::string text = "# bodice: convex pieces of proxy " + engine::hex64(proxy.hash()) + "\n";
  const std::vector<std::string> names = names_of(pieces);
  std::size_t first = 1;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    text += "o " + names[i] + "\n";
    for (const Vec3& p : pieces[i].mesh.positions) {
      text += 'v';
      for (const double v : proxy.frame().to_file(p)) text += ' ', engine::append_number(text, v, 9);
      text += '\n';
    }
    for (const geometry::Triangle& t : pieces[i].mesh.triangles) {
      text += 'f';
      for (const geometry::Index v : t) text += ' ' + std::to_string(first + v);
      text += '\n';
    }
    first += pieces[i].mesh.positions.size();
  }
  return text;
}

}  // namespace bodice::colliders
