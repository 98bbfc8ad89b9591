#include "coordinates/crotch_line.hpp"

#include <cmath>
#include <limits>

#include "skin/curve.hpp"

namespace bodice::inline v0_1::anatomy {
namespace {

using geodesic::Field;
using geodesic::Isoline;
using geometry::Vec3;

/// A point of one of several lines.
struct Nearest {
  const Isoline* line = nullptr;
  std::size_t point = 0;
};

Nearest closest_point(const std::vector<Isoline>& lines, const Vec3& p) {
  Nearest nearest;
  double least = std::numeric_limits<double>::infinity();
  for (const Isoline& line : lines)
    for (std::size_t i = 0; i < line.points.size(); ++i) {
      const double d = (line.points[i] - p).squaredNorm();
      if (!(d < least)) continue;
      least = d;
      nearest = {&line, i};
    }
  return nearest;
}

/// One half of the line, from its middle.
struct Half {
  std::array<Vec3, CrotchLine::kReach> point{};
  std::size_t last = 0;  ///< point of the line where it ends
};

/// Equal steps along the line from one of its points, in direction 1 or -1; empty if the line ends, or comes
/// round, before.
std::optional<Half> walk(const Isoline& line, std::size_t from, int direction, double step) {
  Half half;
  const auto n = static_cast<std::ptrdiff_t>(line.points.size());
  auto i = static_cast<std::ptrdiff_t>(from);
  double walked = 0.0;
  int taken = 0;
  for (std::ptrdiff_t segments = 0; taken < CrotchLine::kReach; ++segments) {
    if (segments == n) return std::nullopt;
    const std::ptrdiff_t next = i + direction;
    if (!line.closed && (next < 0 || next >= n)) return std::nullopt;
    const Vec3 &p = line.points[static_cast<std::size_t>(i)],
               &q = line.points[static_cast<std::size_t>((next + n) % n)];
    const double length = (q - p).norm();
    for (; taken < CrotchLine::kReach && (taken + 1) * step <= walked + length; ++taken)
      half.point[static_cast<std::size_t>(taken)] = p + ((taken + 1) * step - walked) / length * (q - p);
    walked += length;
    i = (next + n) % n;
  }
  half.last = static_cast<std::size_t>(i);
  return half;
}

std::vector<Isoline> lines_between_feet(const Skin& skin, const BodyExtremities& tips) {
  Field nearer_left(skin.mesh.positions.size());
  for (std::size_t v = 0; v < nearer_left.size(); ++v)
    nearer_left[v] = (*tips.from_foot[0])[v] - (*tips.from_foot[1])[v];
  const float zero = 0.0F;
  return geodesic::isolines(skin.mesh, skin.edges, nearer_left, {&zero, 1})[0];
}

/// How much nearer a point of the line lies to the breastbone than to the back.
float frontness(const Skin& skin, const BodyCoordinates& coordinates, const Isoline& line,
                std::size_t point) {
  return value_at(skin, line, point, coordinates.from_back()) -
         value_at(skin, line, point, coordinates.from_front());
}

void smooth(CrotchLine& line) {
  constexpr int kSmoothings = 2;
  for (int pass = 0; pass < kSmoothings; ++pass) {
    const auto before = line.point;
    for (std::size_t i = 1; i + 1 < before.size(); ++i)
      line.point[i] = 0.25 * (before[i - 1] + before[i + 1]) + 0.5 * before[i];
  }
}

}  // namespace

std::optional<CrotchLine> crotch_line(const Skin& skin, const BodyCoordinates& coordinates,
                                      const Vec3& middle) {
  const std::vector<Isoline> lines = lines_between_feet(skin, coordinates.extremities());
  const Nearest nearest = closest_point(lines, middle);
  const double step = CrotchLine::kSpacing * static_cast<double>(coordinates.size_m());
  constexpr int kReach = CrotchLine::kReach;
  if (nearest.line == nullptr || !(nearest.line->girth_m > 2.0 * kReach * step)) return std::nullopt;
  const Isoline& line = *nearest.line;
  const std::optional<Half> one = walk(line, nearest.point, 1, step);
  const std::optional<Half> other = walk(line, nearest.point, -1, step);
  if (!one || !other) return std::nullopt;
  const bool one_is_front =
      frontness(skin, coordinates, line, one->last) > frontness(skin, coordinates, line, other->last);
  const auto &front = one_is_front ? one->point : other->point,
             &back = one_is_front ? other->point : one->point;
  CrotchLine found;
  found.point[kReach] = line.points[nearest.point];
  for (std::size_t i = 0; i < kReach; ++i) {
    found.point[kReach - 1 - i] = front[i];
    found.point[kReach + 1 + i] = back[i];
  }
  smooth(found);
  return found;
}

}  // namespace bodice::anatomy
