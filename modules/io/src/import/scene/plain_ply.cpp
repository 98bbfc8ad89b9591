// Based on: Turk. The PLY Polygon File Format. 1994.
#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>
#include <string>

#include "import/scene/plain_mesh.hpp"
#include "import/source/words.hpp"

namespace bodice::inline v0_1::io {
namespace {

using geometry::Index;

/// A type of a property, by both of its names.
struct Type {
  std::string_view name, other;
  std::size_t bytes;
};
constexpr std::array kNumbers = {Type{"char", "int8", 1},     Type{"uchar", "uint8", 1},
                                 Type{"short", "int16", 2},   Type{"ushort", "uint16", 2},
                                 Type{"int", "int32", 4},     Type{"uint", "uint32", 4},
                                 Type{"float", "float32", 4}, Type{"double", "float64", 8}};

const Type* type_of(std::string_view word) {
  const auto at =
      std::ranges::find_if(kNumbers, [&](const Type& t) { return t.name == word || t.other == word; });
  return at == kNumbers.end() ? nullptr : &*at;
}

/// What a header states of a plain file: vertices with x, y and z of single precision among other numbers,
/// then faces with lists of indices alone.
struct Header {
  std::size_t vertices = 0, faces = 0;
  std::size_t stride = 0;           ///< bytes of a vertex
  std::array<std::size_t, 3> at{};  ///< where its coordinates are
  std::array<bool, 3> has{};
  bool listed = false;  ///< whether the list of indices was there
  int elements = 0;
};

bool take_count(std::string_view line, std::size_t& count) {
  const std::string_view word = take_word(line);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), count);
  return error == std::errc() && end == word.data() + word.size() && take_word(line).empty();
}

bool take_element(std::string_view line, Header& header) {
  const std::string_view name = take_word(line);
  if (++header.elements == 1) return name == "vertex" && take_count(line, header.vertices);
  return header.elements == 2 && name == "face" && take_count(line, header.faces);
}

bool take_list(std::string_view line, Header& header) {
  const std::string_view count = take_word(line), index = take_word(line), name = take_word(line);
  if (header.elements != 2 || header.listed) return false;
  header.listed = true;
  return (count == "uchar" || count == "uint8") &&
         (index == "int" || index == "int32" || index == "uint" || index == "uint32") &&
         (name == "vertex_indices" || name == "vertex_index");
}

bool take_property(std::string_view line, Header& header) {
  const std::string_view word = take_word(line);
  if (word == "list") return take_list(line, header);
  const Type* type = type_of(word);
  const std::string_view name = take_word(line);
  if (!type || header.elements != 1) return false;
  if (name.size() == 1 && name[0] >= 'x' && name[0] <= 'z') {
    const auto k = static_cast<std::size_t>(name[0] - 'x');
    if (type->name != "float" || header.has[k]) return false;
    header.has[k] = true;
    header.at[k] = header.stride;
  }
  header.stride += type->bytes;
  return true;
}

/// Takes the header off the bytes; nothing where the file is not plain.
std::optional<Header> take_header(std::string_view& bytes) {
  Header header;
  bool binary = false;
  for (int line_number = 0;; ++line_number) {
    const std::size_t length = bytes.find('\n');
    if (length == std::string_view::npos) return std::nullopt;
    std::string_view line = bytes.substr(0, length);
    bytes.remove_prefix(length + 1);
    if (line.ends_with('\r')) return std::nullopt;
    const std::string_view word = take_word(line);
    if (word == "end_header") break;
    if (word == "format")
      binary = take_word(line) == "binary_little_endian";
    else if (word == "element" ? !take_element(line, header)
                               : word == "property" && !take_property(line, header))
      return std::nullopt;
    else if (word != "element" && word != "property" && word != "comment" && word != "obj_info" &&
             line_number > 0)
      return std::nullopt;
  }
  const bool whole = binary && header.listed && header.has[0] && header.has[1] && header.has[2];
  return whole ? std::optional(header) : std::nullopt;
}

template <class Value>
Value value_at(const char* at) {
  Value value;
  std::memcpy(&value, at, sizeof value);
  return value;
}

void read_vertices(const Header& header, const char* at, geometry::TriMesh& mesh) {
  mesh.positions.reserve(header.vertices);
  for (std::size_t v = 0; v < header.vertices; ++v, at += header.stride) {
    geometry::Vec3& p = mesh.positions.emplace_back();
    for (std::size_t k = 0; k < 3; ++k)
      p[static_cast<Eigen::Index>(k)] = 0.0 + static_cast<double>(value_at<float>(at + header.at[k]));
  }
}

/// Reads triangles; false where there is another polygon, or one without its vertices.
bool read_triangles(const Header& header, std::string_view bytes, geometry::TriMesh& mesh) {
  constexpr std::size_t kBytes = 1 + 3 * sizeof(std::uint32_t);
  if (bytes.size() != header.faces * kBytes) return false;
  mesh.triangles.reserve(header.faces);
  for (const char* at = bytes.data(); at != bytes.data() + bytes.size(); at += kBytes) {
    geometry::Triangle& corners = mesh.triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = value_at<std::uint32_t>(at + 1 + k * sizeof(std::uint32_t));
      if (corners[k] >= header.vertices) return false;
    }
    if (*at != 3) return false;
  }
  return !mesh.triangles.empty();
}

}  // namespace

std::optional<FileMesh> read_plain_ply(const std::string& file) {
  if constexpr (std::endian::native != std::endian::little) return std::nullopt;
  std::string_view bytes = file;
  const auto header = take_header(bytes);
  if (!header || header->vertices > bytes.size() / header->stride || header->faces > bytes.size())
    return std::nullopt;
  FileMesh mesh;
  read_vertices(*header, bytes.data(), mesh.shape);
  bytes.remove_prefix(header->vertices * header->stride);
  if (!read_triangles(*header, bytes, mesh.shape)) return std::nullopt;
  return mesh;
}

}  // namespace bodice::io
