#include "figure.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <limits>

#include <Eigen/LU>
#include <bodice_test/shapes.hpp>
#include <nlohmann/json.hpp>

namespace io_test {

namespace {

std::string number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.9g", value);
  return text;
}

std::string triple(const Vec3& p) {
  return number(p.x()) + ' ' + number(p.y()) + ' ' + number(p.z());
}

template <class T>
void append_bytes(std::string& bytes, T value) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  bytes.append(raw, sizeof value);
}

void append_floats(std::string& bytes, const Vec3& p) {
  for (int k = 0; k < 3; ++k) append_bytes(bytes, static_cast<float>(p[k]));
}

double farthest_from(const TriMesh& from, const TriMesh& to) {
  double worst = 0.0;
  for (const Vec3& p : from.positions) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Vec3& q : to.positions) nearest = std::min(nearest, (p - q).squaredNorm());
    worst = std::max(worst, nearest);
  }
  return std::sqrt(worst);
}

std::string base64(const std::string& bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (int k = 0; k < 4; ++k)
      text += i + static_cast<std::size_t>(k) > bytes.size() ? '=' : digits[bits >> (18 - 6 * k) & 63u];
  }
  return text;
}

}  // namespace

TriMesh figure() {
  return mapped(bodice_test::icosphere(1.0, 3), [](const Vec3& p) {
    return Vec3(0.28 * p.x() * (1.0 + 0.2 * p.y()), 0.85 * p.y() + 0.85, 0.16 * p.z() + 0.05 * p.y() * p.y());
  });
}

double vertex_distance(const TriMesh& a, const TriMesh& b) {
  return std::max(farthest_from(a, b), farthest_from(b, a));
}

std::string to_obj(const std::vector<NamedMesh>& groups) {
  std::string text = "# written by a test\n";
  std::size_t first = 1;
  for (const auto& [name, mesh] : groups) {
    if (!name.empty()) text += "o " + name + "\n";
    for (const Vec3& p : mesh.positions) text += "v " + triple(p) + "\n";
    for (const auto& [a, b, c] : mesh.triangles)
      text += "f " + std::to_string(a + first) + ' ' + std::to_string(b + first) + ' ' +
              std::to_string(c + first) + "\n";
    first += mesh.positions.size();
  }
  return text;
}

std::string to_ply(const TriMesh& mesh, bool binary) {
  std::string text = std::string("ply\nformat ") + (binary ? "binary_little_endian" : "ascii") +
                     " 1.0\nelement vertex " + std::to_string(mesh.positions.size()) +
                     "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
                     std::to_string(mesh.triangles.size()) +
                     "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Vec3& p : mesh.positions) {
    if (binary)
      append_floats(text, p);
    else
      text += triple(p) + "\n";
  }
  for (const auto& t : mesh.triangles) {
    if (binary) {
      append_bytes(text, std::uint8_t{3});
      for (const auto v : t) append_bytes(text, static_cast<std::int32_t>(v));
    } else {
      text += "3 " + std::to_string(t[0]) + ' ' + std::to_string(t[1]) + ' ' + std::to_string(t[2]) + "\n";
    }
  }
  return text;
}

std::string to_stl(const TriMesh& mesh, bool binary) {
  std::string text = binary ? std::string(80, 'x') : "solid figure\n";
  if (binary) append_bytes(text, static_cast<std::uint32_t>(mesh.triangles.size()));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3 normal = area_vector(mesh, t).normalized();
    if (binary) {
      append_floats(text, normal);
      for (int k = 0; k < 3; ++k) append_floats(text, mesh.corner(t, k));
      append_bytes(text, std::uint16_t{0});
    } else {
      text += "facet normal " + triple(normal) + "\n outer loop\n";
      for (int k = 0; k < 3; ++k) text += "  vertex " + triple(mesh.corner(t, k)) + "\n";
      text += " endloop\nendfacet\n";
    }
  }
  return binary ? text : text + "endsolid figure\n";
}

std::string to_collada(const std::vector<NamedMesh>& meshes, double meters_per_unit,
                       std::string_view up_axis) {
  std::string geometries, nodes;
  for (const auto& [name, mesh] : meshes) {
    std::string positions, indices;
    for (const Vec3& p : mesh.positions) positions += triple(p) + ' ';
    for (const auto& t : mesh.triangles)
      for (const auto v : t) indices += std::to_string(v) + ' ';
    geometries += "<geometry id=\"" + name + "\" name=\"" + name + "\"><mesh><source id=\"" + name +
                  "-p\"><float_array id=\"" + name + "-a\" count=\"" +
                  std::to_string(3 * mesh.positions.size()) + "\">" + positions +
                  "</float_array><technique_common><accessor source=\"#" + name + "-a\" count=\"" +
                  std::to_string(mesh.positions.size()) +
                  "\" stride=\"3\"><param name=\"X\" type=\"float\"/><param name=\"Y\" type=\"float\"/>"
                  "<param name=\"Z\" type=\"float\"/></accessor></technique_common></source><vertices id=\"" +
                  name + "-v\"><input semantic=\"POSITION\" source=\"#" + name +
                  "-p\"/></vertices><triangles count=\"" + std::to_string(mesh.triangles.size()) +
                  "\"><input semantic=\"VERTEX\" source=\"#" + name + "-v\" offset=\"0\"/><p>" + indices +
                  "</p></triangles></mesh></geometry>";
    nodes += "<node id=\"n" + name + "\"><instance_geometry url=\"#" + name + "\"/></node>";
  }
  return "<?xml version=\"1.0\"?><COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" "
         "version=\"1.4.1\"><asset><unit name=\"u\" meter=\"" +
         number(meters_per_unit) + "\"/><up_axis>" + std::string(up_axis) +
         "</up_axis></asset><library_geometries>" + geometries +
         "</library_geometries><library_visual_scenes><visual_scene id=\"s\">" + nodes +
         "</visual_scene></library_visual_scenes><scene><instance_visual_scene "
         "url=\"#s\"/></scene></COLLADA>";
}

std::string to_gltf(const TriMesh& mesh, const std::string& node_matrix, const std::string& joint_matrix) {
  using Json = nlohmann::json;
  std::string bytes;
  Json document = {{"asset", {{"version", "2.0"}}}, {"scene", 0}};
  auto add = [&](std::size_t begin, std::size_t count, int component, const char* type) {
    document["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", begin}, {"byteLength", bytes.size() - begin}});
    document["accessors"].push_back({{"bufferView", document["bufferViews"].size() - 1},
                                     {"componentType", component},
                                     {"count", count},
                                     {"type", type}});
    while (bytes.size() % 4) bytes += '\0';
    return document["accessors"].size() - 1;
  };
  std::size_t begin = bytes.size();
  for (const Vec3& p : mesh.positions) append_floats(bytes, p);
  const auto box = bodice::geometry::bounding_box(mesh.positions);
  const std::size_t positions = add(begin, mesh.positions.size(), 5126, "VEC3");
  document["accessors"][positions]["min"] = {box.low.x(), box.low.y(), box.low.z()};
  document["accessors"][positions]["max"] = {box.high.x(), box.high.y(), box.high.z()};
  begin = bytes.size();
  for (const auto& t : mesh.triangles)
    for (const auto v : t) append_bytes(bytes, static_cast<std::uint32_t>(v));
  const std::size_t indices = add(begin, 3 * mesh.triangles.size(), 5125, "SCALAR");
  Json attributes = {{"POSITION", positions}};
  document["nodes"].push_back({{"name", "holder"}, {"mesh", 0}, {"matrix", Json::parse(node_matrix)}});
  document["scenes"] = {{{"nodes", {0}}}};
  if (!joint_matrix.empty()) {
    begin = bytes.size();
    for (std::size_t v = 0; v < mesh.positions.size(); ++v)
      for (int k = 0; k < 4; ++k) append_bytes(bytes, std::uint8_t{0});
    attributes["JOINTS_0"] = add(begin, mesh.positions.size(), 5121, "VEC4");
    begin = bytes.size();
    for (std::size_t v = 0; v < mesh.positions.size(); ++v)
      for (const float w : {1.0f, 0.0f, 0.0f, 0.0f}) append_bytes(bytes, w);
    attributes["WEIGHTS_0"] = add(begin, mesh.positions.size(), 5126, "VEC4");
    begin = bytes.size();
    for (int k = 0; k < 16; ++k) append_bytes(bytes, k % 5 == 0 ? 1.0f : 0.0f);
    const std::size_t inverse = add(begin, 1, 5126, "MAT4");
    document["nodes"].push_back({{"name", "joint"}, {"matrix", Json::parse(joint_matrix)}});
    document["scenes"][0]["nodes"].push_back(1);
    document["skins"] = {{{"joints", {1}}, {"inverseBindMatrices", inverse}}};
    document["nodes"][0]["skin"] = 0;
  }
  document["meshes"] = {
      {{"name", "figure"}, {"primitives", {{{"attributes", attributes}, {"indices", indices}}}}}};
  document["buffers"] = {
      {{"byteLength", bytes.size()}, {"uri", "data:application/octet-stream;base64," + base64(bytes)}}};
  return document.dump();
}

}  // namespace io_test
