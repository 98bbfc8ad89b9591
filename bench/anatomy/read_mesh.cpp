#include "read_mesh.hpp"

#include <cstring>
#include <fstream>
#include <sstream>

namespace bench {
namespace {

using bodice::geometry::Index;
using bodice::geometry::TriMesh;
using bodice::geometry::Vec3;

TriMesh read_obj(std::istream& in) {
  TriMesh mesh;
  std::string line;
  while (std::getline(in, line)) {
    std::istringstream words(line);
    std::string key;
    words >> key;
    if (key == "v") {
      Vec3 p;
      words >> p.x() >> p.y() >> p.z();
      mesh.positions.push_back(p);
    } else if (key == "f") {
      std::vector<Index> face;
      for (std::string word; words >> word;) face.push_back(static_cast<Index>(std::stoul(word) - 1));
      for (std::size_t k = 2; k < face.size(); ++k) mesh.triangles.push_back({face[0], face[k - 1], face[k]});
    }
  }
  return mesh;
}

template <class T>
T take(std::istream& in) {
  T value{};
  in.read(reinterpret_cast<char*>(&value), sizeof value);
  return value;
}

std::size_t bytes_of(const std::string& type) {
  if (type == "double") return 8;
  if (type == "char" || type == "uchar" || type == "int8" || type == "uint8") return 1;
  return type == "short" || type == "ushort" ? 2 : 4;
}

/// Vertices with float x y z as their first three properties; faces as uchar-counted lists of 4-byte indices.
TriMesh read_ply(std::istream& in) {
  std::size_t vertices = 0, faces = 0, stride = 0;
  bool in_vertices = false;
  for (std::string line; std::getline(in, line) && line.substr(0, 10) != "end_header";) {
    std::istringstream words(line);
    std::string key, kind, type;
    words >> key >> kind;
    if (key == "element") {
      in_vertices = kind == "vertex";
      words >> (in_vertices ? vertices : faces);
    } else if (key == "property" && in_vertices) {
      stride += bytes_of(kind);
    }
  }
  TriMesh mesh;
  std::vector<char> record(stride);
  for (std::size_t v = 0; v < vertices; ++v) {
    in.read(record.data(), static_cast<std::streamsize>(stride));
    float xyz[3];
    std::memcpy(xyz, record.data(), sizeof xyz);
    mesh.positions.emplace_back(xyz[0], xyz[1], xyz[2]);
  }
  for (std::size_t f = 0; f < faces; ++f) {
    const auto count = take<unsigned char>(in);
    std::vector<Index> face(count);
    for (Index& i : face) i = take<Index>(in);
    for (std::size_t k = 2; k < face.size(); ++k) mesh.triangles.push_back({face[0], face[k - 1], face[k]});
  }
  return mesh;
}

TriMesh read_stl(std::istream& in) {
  in.ignore(80);
  const auto count = take<std::uint32_t>(in);
  TriMesh mesh;
  for (std::uint32_t f = 0; f < count; ++f) {
    in.ignore(12);
    for (int k = 0; k < 3; ++k) {
      const auto x = take<float>(in), y = take<float>(in), z = take<float>(in);
      mesh.positions.emplace_back(x, y, z);
    }
    in.ignore(2);
    const auto n = static_cast<Index>(mesh.positions.size());
    mesh.triangles.push_back({n - 3, n - 2, n - 1});
  }
  return mesh;
}

}  // namespace

TriMesh read_mesh(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (file.extension() == ".ply") return read_ply(in);
  return file.extension() == ".stl" ? read_stl(in) : read_obj(in);
}

}  // namespace bench
