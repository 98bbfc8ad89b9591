// Based on: A. M. Andrew. Another efficient algorithm for convex hulls in two dimensions. 1979.
#include "measure/tape.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace bodice::inline v0_1::anatomy {
namespace {

/// Twice the area of a triangle; positive where it turns to the front.
double turn(const CutPoint& a, const CutPoint& b, const CutPoint& c) {
  return (b.left - a.left) * (c.front - a.front) - (b.front - a.front) * (c.left - a.left);
}

/// The hull's half behind (sign 1) or in front (sign -1) of the line from the rightmost to the leftmost
/// point.
std::vector<CutPoint> half_hull(const std::vector<CutPoint>& sorted, double sign) {
  std::vector<CutPoint> hull;
  for (const CutPoint& p : sorted) {
    while (hull.size() > 1 && sign * turn(hull[hull.size() - 2], hull.back(), p) <= 0.0) hull.pop_back();
    hull.push_back(p);
  }
  return hull;
}

/// Length of what lies less far to the front than `front`.
double length_behind(const std::vector<CutPoint>& line, double front) {
  double length = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const double one = std::min(line[i - 1].front, line[i].front);
    const double other = std::max(line[i - 1].front, line[i].front);
    const double share = other <= front ? 1.0 : one >= front ? 0.0 : (front - one) / (other - one);
    length += share * std::hypot(line[i].left - line[i - 1].left, line[i].front - line[i - 1].front);
  }
  return length;
}

}  // namespace

std::vector<CutPoint> cut(const geometry::TriMesh& skin, std::span<const body::Part> part,
                          std::span<const body::Part> of_parts, const CutPlane& plane) {
  std::array<bool, body::kPartCount> wanted{};
  for (const body::Part p : of_parts) wanted[static_cast<std::size_t>(p)] = true;
  std::vector<CutPoint> points;
  const auto add = [&](const geometry::Vec3& p) {
    points.push_back({(p - plane.origin).dot(plane.left), (p - plane.origin).dot(plane.front)});
  };
  for (const geometry::Triangle& t : skin.triangles) {
    if (!std::ranges::all_of(t, [&](geometry::Index v) { return wanted[static_cast<std::size_t>(part[v])]; }))
      continue;
    for (int k = 0; k < 3; ++k) {
      const geometry::Vec3 &a = skin.positions[t[k]], &b = skin.positions[t[(k + 1) % 3]];
      const double at_a = (a - plane.origin).dot(plane.normal), at_b = (b - plane.origin).dot(plane.normal);
      if ((at_a > 0.0) != (at_b > 0.0)) add(a + at_a / (at_a - at_b) * (b - a));
    }
  }
  std::ranges::sort(points, [](const CutPoint& a, const CutPoint& b) {
    return a.left != b.left ? a.left < b.left : a.front < b.front;
  });
  return points;
}

Tape::Tape(const std::vector<CutPoint>& sorted)
    : back_(half_hull(sorted, 1.0)), front_(half_hull(sorted, -1.0)) {}

double Tape::girth() const {
  constexpr double kAnywhere = std::numeric_limits<double>::infinity();
  return length_behind(back_, kAnywhere) + length_behind(front_, kAnywhere);
}

double Tape::back_length() const {
  const auto by_front = [](const CutPoint& a, const CutPoint& b) { return a.front < b.front; };
  const double middle = 0.5 * (std::ranges::min_element(back_, by_front)->front +
                               std::ranges::max_element(front_, by_front)->front);
  return length_behind(back_, middle) + length_behind(front_, middle);
}

double Tape::front_at(double left) const {
  const auto after = std::ranges::lower_bound(front_, left, {}, &CutPoint::left);
  if (after == front_.end()) return front_.back().front;
  if (after == front_.begin()) return front_.front().front;
  const CutPoint &a = *(after - 1), &b = *after;
  return a.front + (left - a.left) / (b.left - a.left) * (b.front - a.front);
}

}  // namespace bodice::anatomy
