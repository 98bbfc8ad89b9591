#include "point_frame.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

namespace bodice::fitting {
namespace {

/// The residual p - origin with the directions so far removed.
Vec3 residual(const Vec3& p, const PointFrame& frame, int directions) {
  Vec3 r = p - frame.origin;
  for (int j = 0; j < directions; ++j) r -= frame.axes.col(j).dot(r) * frame.axes.col(j);
  return r;
}

/// The unit direction of the farthest residual, or zero length if all residuals vanish.
Vec3 farthest_direction(const PointFrame& frame, int directions) {
  Vec3 best = Vec3::Zero();
  double best_length = 0.0;
  for (const Vec3& p : frame.kept) {
    const Vec3 r = residual(p, frame, directions);
    const double length = r.stableNorm();
    if (length > best_length) {
      best_length = length;
      best = r / length;
    }
  }
  return best;
}

Vec3 any_orthogonal(const Vec3& a) {
  int smallest = 0;
  a.cwiseAbs().minCoeff(&smallest);
  return a.cross(Vec3::Unit(smallest)).normalized();
}

void choose_axes(PointFrame& frame) {
  Vec3 first = farthest_direction(frame, 0);
  if (first.squaredNorm() == 0.0) return;
  frame.axes.col(0) = first;
  Vec3 second = farthest_direction(frame, 1);
  second -= first.dot(second) * first;
  frame.axes.col(1) = second.squaredNorm() > 0.25 ? Vec3(second.normalized()) : any_orthogonal(first);
  frame.axes.col(2) = first.cross(Vec3(frame.axes.col(1))).normalized();
}

/// Projects on the axes and moves the origin to the middle of each range.
void project(PointFrame& frame) {
  const std::size_t n = frame.kept.size();
  for (int j = 0; j < 3; ++j) {
    auto& y = frame.y[j];
    y.resize(n);
    for (std::size_t i = 0; i < n; ++i) y[i] = frame.axes.col(j).dot(frame.kept[i] - frame.origin);
    const auto [low, high] = std::minmax_element(y.begin(), y.end());
    const double middle = 0.5 * (*low + *high);
    frame.extent[j] = 0.5 * (*high - *low);
    for (double& value : y) value -= middle;
    frame.origin += middle * frame.axes.col(j);
  }
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
  // A point of the set: an origin off a flat set's plane would make the set look thick.
  frame.origin = frame.kept[0];
  choose_axes(frame);
  project(frame);
  sort_axes(frame);

  // Coordinates far from the origin carry their own rounding, whatever the set's size.
  const double noise = 8.0 * std::numeric_limits<double>::epsilon() * frame.origin.cwiseAbs().maxCoeff();
  const double flat = std::max(flat_relative * frame.extent[0], noise);
  while (frame.rank < 3 && frame.extent[frame.rank] > flat) ++frame.rank;
  if (frame.rank < 3) frame.thickness = frame.extent[frame.rank];
  for (int j = 0; j < frame.rank; ++j)
    for (double& value : frame.y[j]) value /= frame.extent[j];
  return frame;
}

}  // namespace bodice::fitting
