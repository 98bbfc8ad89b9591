// Based on: A. M. Andrew. Another efficient algorithm for convex hulls in two dimensions. 1979.
#include "joints/sole.hpp"

#include <algorithm>
#include <limits>
#include <vector>

namespace bodice::inline v0_1::rigging {
namespace {

using Vec2 = Eigen::Vector2d;

/// An outline's edge faces the floor when its normal makes less than this cosine's angle with the shin: 65
/// degrees.
constexpr double kFacesFloor = 0.42;

double cross(const Vec2& o, const Vec2& a, const Vec2& b) {
  return (a - o).x() * (b - o).y() - (a - o).y() * (b - o).x();
}

/// Counter-clockwise, without the repeated first point.
std::vector<Vec2> convex_hull(std::vector<Vec2> points) {
  std::sort(points.begin(), points.end(),
            [](const Vec2& a, const Vec2& b) { return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y()); });
  std::vector<Vec2> hull;
  const auto chain = [&](auto begin, auto end) {
    const std::size_t start = hull.size();
    for (auto p = begin; p != end; ++p) {
      while (hull.size() >= start + 2 && cross(hull[hull.size() - 2], hull.back(), *p) <= 0.0)
        hull.pop_back();
      hull.push_back(*p);
    }
    hull.pop_back();
  };
  if (points.size() < 3) return {};
  chain(points.begin(), points.end());
  chain(points.rbegin(), points.rend());
  return hull;
}

}  // namespace

std::optional<Sole> find_sole(std::span<const Vec3> foot, const Vec3& across, const Vec3& shin) {
  // The outline lies in the plane of the front (x) and of the direction up the shin (y).
  const Mat3 side = frame_of(across, -shin);
  std::vector<Vec2> outline;
  for (const Vec3& p : foot) outline.push_back({side.col(2).dot(p), side.col(1).dot(p)});
  const std::vector<Vec2> hull = convex_hull(std::move(outline));
  Vec2 best = Vec2::Zero();
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vec2 edge = hull[(i + 1) % hull.size()] - hull[i];
    // The outline is walked with its inside at the left, so that the sole is walked to the front.
    const double facing = edge.x() / edge.norm();
    if (facing > kFacesFloor && edge.norm() > best.norm()) best = edge;
  }
  if (best.norm() == 0.0) return std::nullopt;
  Sole sole;
  const Vec3 forward = (best.x() * side.col(2) + best.y() * side.col(1)).normalized();
  sole.frame << side.col(0), forward.cross(side.col(0)), forward;
  sole.height = sole.rear = std::numeric_limits<double>::infinity();
  sole.front = -sole.rear;
  for (const Vec3& p : foot) {
    sole.height = std::min(sole.height, sole.frame.col(1).dot(p));
    sole.rear = std::min(sole.rear, forward.dot(p));
    sole.front = std::max(sole.front, forward.dot(p));
  }
  return sole;
}

}  // namespace bodice::rigging
