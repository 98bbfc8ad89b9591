#include "garment/outline.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

namespace bodice::inline v0_1::synth {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

double cross(const Point2& o, const Point2& a, const Point2& b) {
  return (a.x - o.x) * (b.z - o.z) - (a.z - o.z) * (b.x - o.x);
}

}  // namespace

engine::Result<TrunkFrame> trunk_frame(const SegmentedBody& body) {
  if (body.part.size() != body.mesh.positions.size() || body.landmarks.size() < body::kLandmarkCount ||
      !(body.stature_m > 0.0))
    return engine::Error{engine::ErrorCode::kUnusableGeometry,
                         "The body has no part a vertex, landmarks and stature.",
                         "Segment the body before making a garment for it."};
  const auto mark = [&](body::LandmarkId id) {
    return body.landmarks[static_cast<std::size_t>(id)].position;
  };
  const Vec3 perineum = mark(body::LandmarkId::kPerineum);
  const Vec3 up = mark(body::LandmarkId::kNeck) - perineum;
  const Vec3 across = mark(body::LandmarkId::kArmpitL) - mark(body::LandmarkId::kArmpitR);
  const Vec3 front = across.cross(up);
  const double least = 0.02 * body.stature_m;
  if (!(up.norm() > least && across.norm() > least && front.norm() > least * least))
    return engine::Error{engine::ErrorCode::kUnusableGeometry,
                         "The neck, perineum and armpit landmarks do not span a trunk.",
                         "Check the segmentation's warnings about landmarks."};
  TrunkFrame frame;
  frame.origin = perineum;
  frame.axes.col(1) = up.normalized();
  frame.axes.col(2) = front.normalized();
  frame.axes.col(0) = frame.axes.col(1).cross(frame.axes.col(2));
  return frame;
}

Vec3 local_landmark(const SegmentedBody& body, const TrunkFrame& frame, body::LandmarkId id) {
  return frame.to_local(body.landmarks[static_cast<std::size_t>(id)].position);
}

std::vector<Point2> convex_hull(std::vector<Point2> points) {
  std::sort(points.begin(), points.end(),
            [](const Point2& a, const Point2& b) { return a.x < b.x || (a.x == b.x && a.z < b.z); });
  if (points.size() < 3) return points;
  std::vector<Point2> hull(2 * points.size());
  std::size_t n = 0;
  const auto push = [&](const Point2& p, std::size_t base) {
    while (n >= base + 2 && cross(hull[n - 2], hull[n - 1], p) <= 0.0) --n;
    hull[n++] = p;
  };
  for (const Point2& p : points) push(p, 0);
  const std::size_t upper = n - 1;
  for (auto p = points.rbegin() + 1; p != points.rend(); ++p) push(*p, upper);
  hull.resize(n - 1);
  return hull;
}

double Outline::at(double angle) const {
  double x = angle / kTurn * kDirections;
  x -= kDirections * std::floor(x / kDirections);
  const int i = static_cast<int>(x) % kDirections;
  const double t = x - std::floor(x);
  return (1.0 - t) * radius[i] + t * radius[(i + 1) % kDirections];
}

Outline outline_of(std::span<const Point2> hull, const Point2& center) {
  Outline outline;
  outline.center = center;
  if (hull.size() < 3) return outline;
  for (int d = 0; d < Outline::kDirections; ++d) {
    const double angle = kTurn * d / Outline::kDirections, c = std::cos(angle), s = std::sin(angle);
    double reach = 1e9;
    for (std::size_t i = 0; i < hull.size(); ++i) {
      const Point2 &a = hull[i], &b = hull[(i + 1) % hull.size()];
      const double nx = b.z - a.z, nz = a.x - b.x, facing = nx * c + nz * s;
      if (facing > 0.0) reach = std::min(reach, (nx * (a.x - center.x) + nz * (a.z - center.z)) / facing);
    }
    outline.radius[d] = reach < 1e9 ? std::max(reach, 0.0) : 0.0;
  }
  return outline;
}

std::vector<double> even_angles(const Outline& outline, int count, double from) {
  constexpr int kSteps = 4 * Outline::kDirections;
  const auto point = [&](int i) {
    const double a = from + kTurn * i / kSteps, r = outline.at(a);
    return std::pair{r * std::cos(a), r * std::sin(a)};
  };
  std::vector<double> length(kSteps + 1, 0.0);
  for (int i = 0; i < kSteps; ++i) {
    const auto [x0, z0] = point(i);
    const auto [x1, z1] = point(i + 1);
    length[i + 1] = length[i] + std::hypot(x1 - x0, z1 - z0);
  }
  std::vector<double> angles;
  for (int k = 0; k < count; ++k) {
    const double wanted = length.back() * k / count;
    const auto above = std::upper_bound(length.begin() + 1, length.end() - 1, wanted);
    const auto i = above - length.begin() - 1;
    const double piece = length[i + 1] - length[i];
    angles.push_back(from +
                     kTurn * (static_cast<double>(i) + (piece > 0.0 ? (wanted - length[i]) / piece : 0.0)) /
                         kSteps);
  }
  return angles;
}

double perimeter(const Outline& outline) {
  double sum = 0.0;
  for (int d = 0; d < Outline::kDirections; ++d) {
    const double step = kTurn / Outline::kDirections, a = outline.radius[d],
                 b = outline.radius[(d + 1) % Outline::kDirections];
    sum += std::sqrt(a * a + b * b - 2.0 * a * b * std::cos(step));
  }
  return sum;
}

}  // namespace bodice::synth
