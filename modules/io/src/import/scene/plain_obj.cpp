// Based on: Wavefront Technologies. Object Files (.obj). 1995.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string>

#include "far_from_origin.hpp"
#include "import/scene/plain_mesh.hpp"
#include "import/scene/triangulate.hpp"
#include "import/source/input_file.hpp"
#include "import/source/words.hpp"

namespace bodice::inline v0_1::io {
namespace {

using geometry::Index;
using geometry::Vec3;

/// Digits of an integer part that surely fit 64 bits, and of a fraction that assimp looks at.
constexpr int kMostDigits = 18, kFractionDigits = 15;
constexpr std::array kTenths = {0.0,
                                0.1,
                                0.01,
                                0.001,
                                0.0001,
                                0.00001,
                                0.000001,
                                0.0000001,
                                0.00000001,
                                0.000000001,
                                0.0000000001,
                                0.00000000001,
                                0.000000000001,
                                0.0000000000001,
                                0.00000000000001,
                                0.000000000000001};

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

bool is_blank(char c) {
  return c == ' ' || c == '\t';
}

bool ends_word(char c) {
  return is_blank(c) || c == '\r' || c == '\n' || c == '\0';
}

/// Takes digits, of which the first `most` count; `count`: how many these are.
std::uint64_t take_digits(const char*& at, int most, int& count) {
  std::uint64_t value = 0;
  for (count = 0; is_digit(*at) && count < most; ++at, ++count)
    value = 10 * value + static_cast<std::uint64_t>(*at - '0');
  while (is_digit(*at)) ++at;
  return value;
}

/// Reads the lines of an OBJ text. Texts end in a zero, at which all loops stop.
class PlainObj {
 public:
  explicit PlainObj(const std::string& text) : at_(text.data()), end_(text.data() + text.size()) {
    positions().reserve(text.size() / 80);
    mesh_.shape.triangles.reserve(text.size() / 40);
  }

  std::optional<FileMesh> read() {
    while (at_ < end_) {
      skip_blanks();
      if (!read_line()) return std::nullopt;
      skip_blanks();
      if (*at_ == '\r') ++at_;
      if (at_ < end_ && *at_++ != '\n') return std::nullopt;
    }
    if (mesh_.shape.triangles.empty()) return std::nullopt;
    return std::move(mesh_);
  }

 private:
  std::vector<Vec3>& positions() { return mesh_.shape.positions; }

  void skip_blanks() {
    while (is_blank(*at_)) ++at_;
  }

  /// Goes to the end of a line that is not used, unless the line goes on in the next one.
  bool skip_line() {
    const void* found = std::memchr(at_, '\n', static_cast<std::size_t>(end_ - at_));
    const char* stop = found ? static_cast<const char*>(found) : end_;
    const char* last = stop;
    while (last > at_ && (last[-1] == '\r' || is_blank(last[-1]))) --last;
    const bool goes_on = last > at_ && last[-1] == '\\';
    at_ = stop;
    return !goes_on;
  }

  bool read_line() {
    if (ends_word(*at_)) return *at_ != '\0' || at_ == end_;
    if (*at_ == '#') return skip_line();
    const char first = *at_, second = at_[1];
    if (first == 'v' && is_blank(second)) return ++at_, read_vertex();
    if (first == 'f' && is_blank(second)) return ++at_, read_face();
    const char* begin = at_;
    while (!ends_word(*at_)) ++at_;
    const std::string_view word(begin, static_cast<std::size_t>(at_ - begin));
    if (word == "vt" || word == "vn" || word == "s" || word == "mtllib") return skip_line();
    if (word == "usemtl") return take_name(mesh_.material);
    return (word == "o" || word == "g") && take_name(mesh_.name);
  }

  /// The one name in the file that stands before all faces: later ones begin other meshes.
  bool take_name(std::string& name) {
    skip_blanks();
    const char* begin = at_;
    while (!ends_word(*at_)) ++at_;
    if (at_ == begin || !name.empty() || !mesh_.shape.triangles.empty()) return false;
    name.assign(begin, at_);
    return true;
  }

  /// A number as assimp reads it in single precision: the fraction is rounded apart.
  bool take_number(float& value) {
    skip_blanks();
    const bool negative = *at_ == '-';
    if (negative || *at_ == '+') ++at_;
    if (!is_digit(*at_)) return false;
    int digits = 0;
    const char* begin = at_;
    value = static_cast<float>(take_digits(at_, kMostDigits, digits));
    if (at_ - begin > kMostDigits) return false;
    if (*at_ == '.') {
      ++at_;
      const auto fraction = static_cast<double>(take_digits(at_, kFractionDigits, digits));
      value += static_cast<float>(fraction * kTenths[static_cast<std::size_t>(digits)]);
    }
    if (*at_ == 'e' || *at_ == 'E') scale(value);
    if (negative) value = -value;
    return ends_word(*at_);
  }

  /// Takes an exponent.
  void scale(float& value) {
    const bool negative = *++at_ == '-';
    if (negative || *at_ == '+') ++at_;
    int digits = 0;
    const auto exponent = static_cast<float>(take_digits(at_, kMostDigits, digits));
    value *= std::pow(10.0F, negative ? -exponent : exponent);
  }

  /// x, y and z, and perhaps a color, which is not kept.
  bool read_vertex() {
    std::array<float, 6> number{};
    std::size_t count = 0;
    for (skip_blanks(); !ends_word(*at_); skip_blanks(), ++count)
      if (count == number.size() || !take_number(number[count])) return false;
    if (count != 3 && count != 6) return false;
    Vec3& p = positions().emplace_back();
    for (std::size_t k = 0; k < 3; ++k)
      p[static_cast<Eigen::Index>(k)] = 0.0 + static_cast<double>(number[k]);
    return true;
  }

  /// The corners of a polygon, each by its position and perhaps more.
  bool read_face() {
    polygon_.clear();
    for (skip_blanks(); !ends_word(*at_); skip_blanks()) {
      int digits = 0;
      const std::uint64_t number = take_digits(at_, kMostDigits, digits);
      if (digits == 0 || number == 0 || number > positions().size()) return false;
      while (is_digit(*at_) || *at_ == '/') ++at_;
      if (!ends_word(*at_)) return false;
      polygon_.push_back(static_cast<Index>(number - 1));
    }
    if (polygon_.size() < 3) return false;
    if (polygon_.size() == 3)
      mesh_.shape.triangles.push_back({polygon_[0], polygon_[1], polygon_[2]});
    else
      triangulate(positions(), polygon_, mesh_.shape.triangles);
    return true;
  }

  const char *at_, *end_;
  FileMesh mesh_;
  std::vector<Index> polygon_;
};

}  // namespace

std::optional<FileMesh> read_plain_obj(const std::string& text) {
  auto mesh = PlainObj(text).read();
  if (!mesh || is_far_from_origin(geometry::bounding_box(mesh->shape.positions))) return std::nullopt;
  share_vertices(*mesh);
  return mesh;
}

std::optional<FileMesh> read_plain_mesh(const std::filesystem::path& file, Format format) {
  if (format == Format::kObj) return read_plain_obj(read_text(file));
  if (format == Format::kPly) return read_plain_ply(read_text(file));
  return std::nullopt;
}

}  // namespace bodice::io
