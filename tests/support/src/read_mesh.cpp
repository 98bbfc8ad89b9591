#include <bodice_test/read_mesh.hpp>

#include <cstring>
#include <fstream>
#include <sstream>
#include <string>

namespace bodice_test {
namespace {

using bodice::geometry::Index;
using bodice::geometry::TriMesh;

void add_polygon(std::istringstream& line, TriMesh& mesh) {
  std::vector<Index> corners;
  for (std::string token; line >> token;) {
    const long number = std::stol(token);  // stops at the slash
    const long count = static_cast<long>(mesh.positions.size());
    corners.push_back(static_cast<Index>(number > 0 ? number - 1 : count + number));
  }
  for (std::size_t k = 2; k < corners.size(); ++k)
    mesh.triangles.push_back({corners[0], corners[k - 1], corners[k]});
}

TriMesh read_obj(std::ifstream& in) {
  TriMesh mesh;
  for (std::string text; std::getline(in, text);) {
    std::istringstream line(text);
    std::string key;
    line >> key;
    if (key == "v") {
      bodice::geometry::Vec3 p;
      line >> p[0] >> p[1] >> p[2];
      mesh.positions.push_back(p);
    } else if (key == "f") {
      add_polygon(line, mesh);
    }
  }
  return mesh;
}

TriMesh read_stl(std::ifstream& in) {
  TriMesh mesh;
  std::uint32_t count = 0;
  in.seekg(80);
  in.read(reinterpret_cast<char*>(&count), 4);
  for (std::uint32_t t = 0; t < count; ++t) {
    char record[50];
    if (!in.read(record, sizeof record)) break;
    float corners[9];
    std::memcpy(corners, record + 12, sizeof corners);
    for (int k = 0; k < 3; ++k)
      mesh.positions.emplace_back(Eigen::Map<Eigen::Vector3f>(corners + 3 * k).cast<double>());
    mesh.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  return mesh;
}

}  // namespace

TriMesh read_mesh(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return {};
  return file.extension() == ".stl" ? read_stl(in) : read_obj(in);
}

}  // namespace bodice_test
