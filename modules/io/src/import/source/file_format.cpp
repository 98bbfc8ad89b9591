// Based on: Khronos Group. glTF 2.0 Specification. 2021. - 4.4 (GLB). Khronos Group. COLLADA 1.5. 2008.
// Wavefront Technologies. Object Files (.obj). 1995. 3D Systems. StereoLithography Interface Specification.
// 1989. Turk. The PLY Polygon File Format. 1994.
#include "import/source/file_format.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>

#include "import/source/words.hpp"

namespace bodice::inline v0_1::io {

namespace {

/// What is looked at, from the beginning and from the end of a file.
constexpr std::size_t kEdge = 1 << 16;
/// Lines of an OBJ text that are looked at, and the least share of them that begins with a word of OBJ:
/// exporters add words of their own.
constexpr int kObjLines = 400;
constexpr double kObjShare = 0.5;

// Formats that index positions apart from normals and textures have their vertices split. Of assimp 5.2.5 the
// readers of Collada and glTF crash on some damaged files, by null pointers and by assertions. That of FBX is
// built alike, so that a format counts as dangerous unless its row states otherwise.
constexpr FormatTraits kTraits[] = {
    {},
    {.format = Format::kObj,
     .extension = "obj",
     .reader = "Wavefront Object Importer",
     .survives_damage = true,
     .splits_vertices = true},
    {.format = Format::kPly,
     .extension = "ply",
     .reader = "Stanford Polygon Library (PLY) Importer",
     .survives_damage = true,
     .has_materials = false},
    {.format = Format::kStl,
     .extension = "stl",
     .reader = "Stereolithography (STL) Importer",
     .survives_damage = true,
     .has_materials = false},
    {.format = Format::kGltf, .extension = "gltf", .reader = "glTF2 Importer"},
    {.format = Format::kGlb, .extension = "glb", .reader = "glTF2 Importer"},
    {.format = Format::kFbx, .extension = "fbx", .reader = "Autodesk FBX Importer", .splits_vertices = true},
    {.format = Format::kCollada, .extension = "dae", .reader = "Collada Importer", .splits_vertices = true},
    {.format = Format::kColladaArchive,
     .extension = "zae",
     .reader = "Collada Importer",
     .splits_vertices = true},
    {.format = Format::kBvh, .extension = "bvh"}};

struct Content {
  std::string head, tail;
  std::uint64_t size = 0;
};

Content look_at(const std::filesystem::path& file) {
  Content content;
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) return content;
  content.size = std::filesystem::file_size(file, error);
  std::ifstream stream(file, std::ios::binary);
  const auto read = [&](std::string& to) {
    to.resize(kEdge);
    stream.read(to.data(), static_cast<std::streamsize>(to.size()));
    to.resize(static_cast<std::size_t>(std::max<std::streamsize>(stream.gcount(), 0)));
  };
  read(content.head);
  if (content.size > kEdge) {
    stream.clear();
    stream.seekg(static_cast<std::streamoff>(content.size - kEdge));
    read(content.tail);
  }
  return content;
}

/// The text without the zeros of UTF-16 and the blanks and byte order marks before its first word.
std::string_view plain_text(std::string& text) {
  std::erase(text, '\0');
  const std::size_t first = text.find_first_not_of(" \t\r\n\xEF\xBB\xBF\xFE\xFF");
  return first == std::string::npos ? std::string_view{} : std::string_view(text).substr(first);
}

bool contains(std::string_view text, std::string_view word) {
  return text.find(word) != std::string_view::npos;
}

bool is_number(std::string_view word) {
  return !word.empty() && word.find_first_not_of("+-.0123456789eEnaifNAIF#QDqd") == std::string_view::npos;
}

bool is_obj_word(std::string_view word) {
  constexpr std::array<std::string_view, 24> kWords = {
      "v",      "vt",     "vn",     "vp",    "f",      "fo",  "l",    "p",     "o",    "g",    "s",   "mg",
      "mtllib", "usemtl", "usemap", "bevel", "cstype", "deg", "curv", "curv2", "surf", "parm", "end", "lod"};
  return std::find(kWords.begin(), kWords.end(), word) != kWords.end();
}

/// Whether a text has vertices of three numbers, and mostly lines of OBJ.
bool is_obj(std::string_view text) {
  int lines = 0, known = 0;
  bool vertex = false, continued = false;
  while (!text.empty() && lines < kObjLines) {
    const std::size_t length = std::min(text.find('\n'), text.size() - 1) + 1;
    std::string_view line = text.substr(0, length);
    text.remove_prefix(length);
    const bool continues = contains(line, "\\\n") || contains(line, "\\\r");
    const std::string_view word = take_word(line);
    if (!std::exchange(continued, continues) && !word.empty() && word.front() != '#') {
      ++lines;
      known += is_obj_word(word);
      if (word == "v")
        vertex |= is_number(take_word(line)) && is_number(take_word(line)) && is_number(take_word(line));
    }
  }
  return vertex && known >= kObjShare * lines;
}

/// A binary STL has 84 bytes and 50 for each triangle, as the header counts them.
bool is_binary_stl(const Content& content) {
  std::uint32_t triangles = 0;
  if (content.size < 84 || content.head.size() < 84) return false;
  std::memcpy(&triangles, content.head.data() + 80, sizeof triangles);
  return content.size == 84 + 50 * std::uint64_t{triangles};
}

bool is_glb_2(std::string_view head) {
  return head.size() >= 12 && head.starts_with("glTF") && head[4] == 2 && head[5] == 0 && head[6] == 0 &&
         head[7] == 0;
}

Format format_of_text(std::string_view text, std::string_view end) {
  if (text.starts_with("HIERARCHY")) return Format::kBvh;
  if (contains(text, "<COLLADA")) return Format::kCollada;
  if (text.starts_with('<')) return Format::kUnknown;
  if (text.starts_with('{'))
    return contains(text, "\"asset\"") || contains(end, "\"asset\"") ? Format::kGltf : Format::kUnknown;
  if (text.starts_with(';') ? contains(text, "FBX") : contains(text, "FBXHeaderExtension"))
    return Format::kFbx;
  if (text.starts_with("solid") && contains(text, "facet")) return Format::kStl;
  return is_obj(text) ? Format::kObj : Format::kUnknown;
}

}  // namespace

Format format_of(const std::filesystem::path& file) {
  Content content = look_at(file);
  const std::string_view head = content.head;
  if (is_glb_2(head)) return Format::kGlb;
  if (head.starts_with("Kaydara FBX Binary")) return Format::kFbx;
  if (head.starts_with("ply\n") || head.starts_with("ply\r")) return Format::kPly;
  if (head.starts_with("PK\3\4")) {
    const bool collada = contains(head, ".dae") || contains(content.tail, ".dae");
    return collada ? Format::kColladaArchive : Format::kUnknown;
  }
  if (is_binary_stl(content)) return Format::kStl;
  return format_of_text(plain_text(content.head), content.tail);
}

const FormatTraits& traits_of(Format format) {
  const auto row = std::ranges::find(kTraits, format, &FormatTraits::format);
  return row != std::end(kTraits) ? *row : kTraits[0];
}

}  // namespace bodice::io
