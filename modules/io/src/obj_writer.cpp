#include <string>

#include <bodice/engine/text.hpp>
#include <bodice/engine/write_file.hpp>
#include <bodice/io/obj.hpp>

namespace bodice::inline v0_1::io {

engine::Result<void> write_obj(const geometry::TriMesh& mesh, const std::filesystem::path& file,
                               const geometry::Frame& frame) {
  std::string text;
  for (const geometry::Vec3& inside : mesh.positions) {
    text += 'v';
    for (const double number : frame.to_file(inside)) {
      text += ' ';
      engine::append_number(text, number, 9);
    }
    text += '\n';
  }
  for (const geometry::Triangle& t : mesh.triangles) {
    text += 'f';
    for (const geometry::Index v : t) text += ' ' + std::to_string(v + 1);
    text += '\n';
  }
  return engine::write_file(file, std::string_view(text));
}

}  // namespace bodice::io
