#include <cstdio>
#include <string>

#include <bodice/io/files.hpp>
#include <bodice/io/obj.hpp>

namespace bodice::io {

engine::Result<void> write_obj(const geometry::TriMesh& mesh, const std::filesystem::path& file,
                               const geometry::Frame& frame) {
  std::string text;
  char line[128];
  for (const geometry::Vec3& inside : mesh.positions) {
    const geometry::Vec3 p = frame.to_file(inside);
    std::snprintf(line, sizeof line, "v %.9g %.9g %.9g\n", p.x(), p.y(), p.z());
    text += line;
  }
  for (const geometry::Triangle& t : mesh.triangles) {
    std::snprintf(line, sizeof line, "f %u %u %u\n", t[0] + 1, t[1] + 1, t[2] + 1);
    text += line;
  }
  return write_file(file, std::string_view(text));
}

}  // namespace bodice::io
