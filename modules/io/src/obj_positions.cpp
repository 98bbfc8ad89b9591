#include <charconv>
#include <fstream>
#include <string>

#include <bodice/io/obj.hpp>

namespace bodice::inline v0_1::io {

namespace {

/// Three numbers behind the `v` of a line; false where they are not there.
bool read_position(const std::string& line, geometry::Vec3& position) {
  const char* at = line.data() + 1;
  const char* const end = line.data() + line.size();
  for (int k = 0; k < 3; ++k) {
    while (at < end && (*at == ' ' || *at == '\t' || *at == '+')) ++at;
    const auto [next, error] = std::from_chars(at, end, position[k]);
    if (error != std::errc()) return false;
    at = next;
  }
  return true;
}

}  // namespace

engine::Result<std::vector<geometry::Vec3>> read_obj_positions(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream)
    return engine::Error{engine::ErrorCode::kNotFound, "'" + file.string() + "' cannot be opened.",
                         "Check the path."};
  std::vector<geometry::Vec3> positions;
  std::string line;
  for (std::size_t number = 1; std::getline(stream, line); ++number) {
    if (line.size() < 2 || line[0] != 'v' || (line[1] != ' ' && line[1] != '\t')) continue;
    if (!read_position(line, positions.emplace_back()))
      return engine::Error{
          engine::ErrorCode::kUnreadable,
          "'" + file.string() + "', line " + std::to_string(number) + ": a vertex is no three numbers.",
          "Export the body again as OBJ."};
  }
  if (positions.empty())
    return engine::Error{engine::ErrorCode::kUnreadable,
                         "'" + file.string() + "' has no vertex as OBJ has them.", "Export the body as OBJ."};
  return positions;
}

}  // namespace bodice::io
