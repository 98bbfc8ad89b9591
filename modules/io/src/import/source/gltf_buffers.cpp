// Based on: Khronos Group. glTF 2.0 Specification. 2021. - section 4.4 (GLB); Josefsson. RFC 4648. 2006.
// (base64)
#include "import/source/gltf_buffers.hpp"

#include <cstdint>
#include <cstring>

#include "glb_chunks.hpp"
#include "import/source/input_file.hpp"

namespace bodice::inline v0_1::io {

namespace {

std::uint32_t word(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  if (at + 4 <= bytes.size()) std::memcpy(&value, bytes.data() + at, 4);
  return value;
}

int base64_digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+' || c == '-') return 62;
  if (c == '/' || c == '_') return 63;
  return -1;
}

std::string decode_base64(std::string_view text) {
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3);
  std::uint32_t group = 0;
  int bits = 0;
  for (const char c : text) {
    const int digit = base64_digit(c);
    if (digit < 0) continue;  // padding and line ends
    group = group << 6 | static_cast<std::uint32_t>(digit);
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes.push_back(static_cast<char>(group >> bits & 0xFF));
  }
  return bytes;
}

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

std::string decode_percent(std::string_view text) {
  std::string decoded;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '%' && i + 2 < text.size() && hex_digit(text[i + 1]) >= 0 && hex_digit(text[i + 2]) >= 0) {
      decoded.push_back(static_cast<char>(16 * hex_digit(text[i + 1]) + hex_digit(text[i + 2])));
      i += 2;
    } else {
      decoded.push_back(text[i]);
    }
  }
  return decoded;
}

}  // namespace

GltfText split_glb(std::string file) {
  if (word(file, 0) != kGlbMagic) return {std::move(file), {}};
  GltfText text;
  for (std::size_t at = 12; at + 8 <= file.size();) {
    const std::size_t length = word(file, at);
    const std::uint32_t kind = word(file, at + 4);
    if (kind == kGlbJsonChunk && text.json.empty()) text.json = file.substr(at + 8, length);
    if (kind == kGlbBinaryChunk && text.binary.empty()) text.binary = file.substr(at + 8, length);
    at += 8 + length;
  }
  return text;
}

std::optional<std::filesystem::path> file_of_uri(std::string_view uri, const std::filesystem::path& folder) {
  if (uri.starts_with("data:")) return std::nullopt;
  return folder / decode_percent(uri);
}

std::string load_uri(std::string_view uri, const std::filesystem::path& folder) {
  const std::optional<std::filesystem::path> file = file_of_uri(uri, folder);
  if (!file) {
    const std::size_t comma = uri.find(',');
    return comma == std::string_view::npos ? "" : decode_base64(uri.substr(comma + 1));
  }
  std::error_code error;  // a device or a pipe has no end
  return std::filesystem::is_regular_file(*file, error) ? read_text(*file) : "";
}

}  // namespace bodice::io
