#include "landmarks/base/head_profile.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace bodice::inline v0_1::anatomy {
namespace {

using geometry::Vec3;
using Point = Eigen::Vector2d;  ///< forward and up from the middle of the head, fractions of the body size

/// The outline is read from the forehead to the back of the head, in radians from the crown; before it lies
/// the nose, and behind it the nape, which are hollow on all heads.
constexpr double kForehead = 0.6, kBack = -1.55;
/// The outline has one point in each step of a degree and a half: the outermost.
constexpr std::size_t kOutlinePoints = 86;

double cross(const Point& a, const Point& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// The points of the outline from the back to the forehead.
std::vector<Point> outline(const LandmarkInput& input, const Vec3& up, const Vec3& forward) {
  const auto& positions = input.skin.mesh.positions;
  const Vec3 across = up.cross(forward);
  std::array<Point, kOutlinePoints> outermost;
  outermost.fill(Point::Zero());
  const auto add = [&](const Vec3& from_middle) {
    const Point p(from_middle.dot(forward) / input.size_m(), from_middle.dot(up) / input.size_m());
    const double turn = (std::atan2(p.x(), p.y()) - kBack) / (kForehead - kBack);
    if (!(turn >= 0.0 && turn < 1.0)) return;
    Point& far = outermost[static_cast<std::size_t>(turn * static_cast<double>(kOutlinePoints))];
    if (p.squaredNorm() > far.squaredNorm()) far = p;
  };
  for (const auto& t : input.skin.mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const geometry::Index v = t[k], w = t[(k + 1) % 3];
      if (input.skin.component[v] != 0 || !input.coordinates.on_head(v)) continue;
      const Vec3 a = positions[v] - input.head.center, b = positions[w] - input.head.center;
      const double side_a = a.dot(across), side_b = b.dot(across);
      if ((side_a >= 0.0) != (side_b >= 0.0)) add(a + side_a / (side_a - side_b) * (b - a));
    }
  std::vector<Point> points;
  for (const Point& p : outermost)
    if (p.norm() * input.size_m() > kOuterHead * input.head.radius) points.push_back(p);
  return points;
}

/// The corners of a band that is stretched over the points.
std::vector<Point> stretched(const std::vector<Point>& points) {
  std::vector<Point> band;
  for (const Point& p : points) {
    while (band.size() > 1 &&
           cross(band.back() - band[band.size() - 2], p - band.back()) >= 0.0)  // a turn to the left
      band.pop_back();
    band.push_back(p);
  }
  return band;
}

}  // namespace

double hollow_of_head(const LandmarkInput& input, const Vec3& up, const Vec3& forward) {
  const std::vector<Point> points = outline(input, up, forward);
  const std::vector<Point> band = stretched(points);
  double deepest = 0.0;
  std::size_t edge = 0;
  for (const Point& p : points) {
    while (edge + 2 < band.size() && cross(p, band[edge + 1]) >= 0.0) ++edge;
    if (edge + 1 >= band.size()) break;
    const Point along = (band[edge + 1] - band[edge]).normalized();
    deepest = std::max(deepest, -cross(along, p - band[edge]));
  }
  return deepest;
}

}  // namespace bodice::anatomy
