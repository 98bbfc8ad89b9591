#include "mvee/point_frame.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

namespace bodice::inline v0_1::fitting {
namespace {

/// A power of two near 1 / (largest coordinate), so that squares neither overflow nor vanish; 0 if all do.
double safe_scale(const PointFrame& frame) {
  double largest = 0.0;
  for (const Vec3& p : frame.kept) largest = std::max(largest, (p - frame.origin).cwiseAbs().maxCoeff());
  return largest > 0.0 ? std::ldexp(1.0, std::clamp(-std::ilogb(largest), -1000, 1000)) : 0.0;
}

/// The unit direction of the longest residual of p - origin, from which the first direction is removed if
/// there is one. Zero if all residuals vanish.
template <int Directions>
Vec3 farthest_direction(const PointFrame& frame, double scale) {
  Vec3 best = Vec3::Zero();
  double farthest = 0.0;
  for (const Vec3& p : frame.kept) {
    Vec3 r = scale * (p - frame.origin);
    if constexpr (Directions == 1) r -= frame.axes.col(0).dot(r) * frame.axes.col(0);
    const double squared = r.squaredNorm();
    if (squared > farthest) farthest = squared, best = r;
  }
  return farthest > 0.0 ? Vec3(best / std::sqrt(farthest)) : best;
}

Vec3 any_orthogonal(const Vec3& a) {
  int smallest = 0;
  a.cwiseAbs().minCoeff(&smallest);
  return a.cross(Vec3::Unit(smallest)).normalized();
}

void choose_axes(PointFrame& frame) {
  const double scale = safe_scale(frame);
  const Vec3 first = farthest_direction<0>(frame, scale);
  if (first.squaredNorm() == 0.0) return;
  frame.axes.col(0) = first;
  Vec3 second = farthest_direction<1>(frame, scale);
  second -= first.dot(second) * first;
  frame.axes.col(1) = second.squaredNorm() > 0.25 ? Vec3(second.normalized()) : any_orthogonal(first);
  frame.axes.col(2) = first.cross(Vec3(frame.axes.col(1))).normalized();
}

/// Projects the points on the axes and moves the origin to the middle of each range.
void project(PointFrame& frame) {
  const std::size_t n = frame.kept.size();
  for (auto& y : frame.y) y.resize(n);
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 along = frame.axes.transpose() * (frame.kept[i] - frame.origin);
    for (int j = 0; j < 3; ++j) frame.y[j][i] = along[j];
    low = low.cwiseMin(along);
    high = high.cwiseMax(along);
  }
  const Vec3 middle = 0.5 * (low + high);
  frame.extent = 0.5 * (high - low);
  frame.origin += frame.axes * middle;
  for (int j = 0; j < 3; ++j)
    for (double& value : frame.y[j]) value -= middle[j];
}

void sort_axes(PointFrame& frame) {
  for (int pass = 0; pass < 2; ++pass)
    for (int j = 0; j < 2; ++j)
      if (frame.extent[j] < frame.extent[j + 1]) {
        std::swap(frame.extent[j], frame.extent[j + 1]);
        std::swap(frame.y[j], frame.y[j + 1]);
        frame.axes.col(j).swap(frame.axes.col(j + 1));
      }
}

}  // namespace

PointFrame make_point_frame(std::span<const Vec3> points, double flat_relative) {
  PointFrame frame;
  frame.kept.reserve(points.size());
  for (const Vec3& p : points)
    if (p.allFinite()) frame.kept.push_back(p);
  if (frame.kept.empty()) return frame;
  // The origin is a point of the set: one off the plane of a flat set would make the set look thick.
  frame.origin = frame.kept[0];
  choose_axes(frame);
  project(frame);
  sort_axes(frame);

  // Coordinates far from the world's origin have rounding of their own, whatever the set's size.
  const double noise = 8.0 * std::numeric_limits<double>::epsilon() * frame.origin.cwiseAbs().maxCoeff();
  const double flat = std::max(flat_relative * frame.extent[0], noise);
  while (frame.rank < 3 && frame.extent[frame.rank] > flat) ++frame.rank;
  if (frame.rank < 3) frame.thickness = frame.extent[frame.rank];
  for (int j = 0; j < frame.rank; ++j)
    for (double& value : frame.y[j]) value /= frame.extent[j];
  return frame;
}

}  // namespace bodice::fitting
