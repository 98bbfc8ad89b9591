#include "import/source/input_file.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <fstream>
#include <iterator>

#include <bodice/engine/text.hpp>

#include "far_from_origin.hpp"
#include "import/source/file_format.hpp"

namespace bodice::inline v0_1::io {

namespace {

std::string_view skip_blanks(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  return first == std::string_view::npos ? std::string_view{} : text.substr(first);
}

std::optional<double> take_number(std::string_view& text) {
  text = skip_blanks(text);
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc()) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return value;
}

/// Reads the position of a `v x y z` line. What follows it (w, colors) is left in `line`.
std::optional<geometry::Vec3> take_vertex(std::string_view& line) {
  std::string_view rest = skip_blanks(line);
  if (rest.size() < 2 || rest[0] != 'v' || (rest[1] != ' ' && rest[1] != '\t')) return std::nullopt;
  rest.remove_prefix(1);
  geometry::Vec3 position;
  for (int k = 0; k < 3; ++k) {
    const auto number = take_number(rest);
    if (!number) return std::nullopt;
    position[k] = *number;
  }
  line = rest;
  return position;
}

/// Whether a PLY header has an end. assimp would search for it beyond the file.
bool has_ply_header(std::istream& stream) {
  constexpr std::size_t kLongest = 1 << 20;
  std::string head(kLongest, '\0');
  stream.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(stream.gcount()));
  for (const std::string_view end : {"\nend_header\n", "\nend_header\r\n", "\rend_header\r"})
    if (head.find(end) != std::string::npos) return true;
  return false;
}

std::uint32_t little_endian(const unsigned char* bytes) {
  return bytes[0] | bytes[1] << 8u | bytes[2] << 16u | static_cast<std::uint32_t>(bytes[3]) << 24u;
}

/// Whether the chunks of a GLB file of version 2 end within it; true for what is no such file. assimp
/// allocates what a chunk claims to have before it reads it.
bool has_whole_chunks(std::istream& stream, std::uint64_t size) {
  unsigned char head[12];
  stream.clear();
  stream.seekg(0);
  const auto read = [&](unsigned count) {
    stream.read(reinterpret_cast<char*>(head), count);
    return stream.gcount() == static_cast<std::streamsize>(count);
  };
  if (!read(12) || std::string_view(reinterpret_cast<const char*>(head), 4) != "glTF") return true;
  if (little_endian(head + 4) != 2) return true;
  if (little_endian(head + 8) > size) return false;
  std::uint64_t at = 12;
  while (at + 8 <= size) {
    stream.seekg(static_cast<std::streamoff>(at));
    if (!read(8)) return false;
    at += 8 + std::uint64_t{little_endian(head)};
    if (at > size) return false;
  }
  return true;
}

template <class Visit>
void for_each_line(std::string_view text, Visit&& visit) {
  while (!text.empty()) {
    const std::size_t length = std::min(text.find('\n'), text.size() - 1) + 1;
    visit(text.substr(0, length));
    text.remove_prefix(length);
  }
}

/// The text between `before` and `after`, after position 0 of `document`.
std::optional<std::string_view> between(std::string_view document, std::string_view before,
                                        std::string_view after) {
  const std::size_t begin = document.find(before);
  if (begin == std::string_view::npos) return std::nullopt;
  const std::size_t end = document.find(after, begin + before.size());
  if (end == std::string_view::npos) return std::nullopt;
  return document.substr(begin + before.size(), end - begin - before.size());
}

}  // namespace

engine::Result<void> check_readable(const std::filesystem::path& file) {
  const std::string name = "'" + file.string() + "'";
  std::error_code error;
  if (!std::filesystem::exists(file, error))
    return engine::Error{engine::ErrorCode::kNotFound, "There is no file " + name + ".",
                         "Check the path and the working directory."};
  if (std::filesystem::is_directory(file, error))
    return engine::Error{engine::ErrorCode::kUnreadable, name + " is a directory, not a mesh file.",
                         "Name the mesh file inside it."};
  if (!std::filesystem::is_regular_file(file, error))  // a device or a pipe has no end and cannot be reread
    return engine::Error{engine::ErrorCode::kUnreadable, name + " is a device or a pipe, not a file.",
                         "Write the mesh to a file first."};
  std::ifstream stream(file, std::ios::binary);
  if (!stream)
    return engine::Error{engine::ErrorCode::kUnreadable, name + " cannot be opened.",
                         "Check that you may read it."};
  if (stream.peek() == std::ifstream::traits_type::eof())
    return engine::Error{engine::ErrorCode::kUnreadable, name + " is empty.", "Export the mesh again."};
  if (format_of(file) == Format::kPly && !has_ply_header(stream))
    return engine::Error{engine::ErrorCode::kUnreadable, name + " has no whole PLY header.",
                         "It may be cut off: export the mesh again."};
  if (!has_whole_chunks(stream, std::filesystem::file_size(file, error)))
    return engine::Error{engine::ErrorCode::kUnreadable,
                         name + " is a GLB with a header that states more bytes than the file has.",
                         "It may be cut off: export the mesh again."};
  return {};
}

std::string read_text(const std::filesystem::path& file) {
  std::string text;
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return text;
  if (error) return {std::istreambuf_iterator<char>(stream), {}};  // a pipe has no size
  text.resize(size);
  stream.read(text.data(), static_cast<std::streamsize>(size));
  text.resize(static_cast<std::size_t>(std::max<std::streamsize>(stream.gcount(), 0)));
  return text;
}

ColladaAsset parse_collada_asset(std::string_view document) {
  ColladaAsset asset;
  if (const auto unit = between(document, "<unit", ">")) {
    for (const std::string_view quote : {"\"", "'"})
      if (auto value = between(*unit, std::string("meter=") + std::string(quote), quote))
        asset.meters_per_unit = take_number(*value);
    if (asset.meters_per_unit && !(*asset.meters_per_unit > 0.0)) asset.meters_per_unit.reset();
  }
  if (const auto axis = between(document, "<up_axis>", "</up_axis>")) {
    if (axis->find("X_UP") != std::string_view::npos) asset.up = geometry::Axis::kX;
    if (axis->find("Y_UP") != std::string_view::npos) asset.up = geometry::Axis::kY;
    if (axis->find("Z_UP") != std::string_view::npos) asset.up = geometry::Axis::kZ;
  }
  return asset;
}

std::optional<MovedObj> move_to_origin(std::string_view obj) {
  geometry::Box box;
  for_each_line(obj, [&](std::string_view line) {
    if (const auto vertex = take_vertex(line); vertex && vertex->allFinite()) box.extend(*vertex);
  });
  if (!is_far_from_origin(box)) return std::nullopt;

  MovedObj moved{{}, box.center().array().round()};
  moved.text.reserve(obj.size());
  for_each_line(obj, [&](std::string_view line) {
    if (const auto vertex = take_vertex(line)) {
      const geometry::Vec3 near = *vertex - moved.offset;
      moved.text += 'v';
      for (const double number : near) {
        moved.text += ' ';
        engine::append_number(moved.text, number, 12);
      }
    }
    moved.text += line;  // what take_vertex left: colors, the line end, or the whole line
  });
  return moved;
}

}  // namespace bodice::io
