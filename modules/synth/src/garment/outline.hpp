// The trunk's own axes, and convex outlines of slices across them, from which garments are cut.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include <bodice/engine/result.hpp>
#include <bodice/synth/garment.hpp>

namespace bodice::inline v0_1::synth {

using geometry::Vec3;

/// The trunk's axes: x to the body's left, y from the perineum toward the neck, z to the front. The origin is
/// the perineum.
struct TrunkFrame {
  geometry::Mat3 axes;  ///< columns x, y, z
  Vec3 origin;
  Vec3 to_local(const Vec3& p) const { return axes.transpose() * (p - origin); }
  Vec3 to_world(const Vec3& p) const { return axes * p + origin; }
};

/// The frame of a body's trunk. Fails when a landmark is missing or two of them coincide.
engine::Result<TrunkFrame> trunk_frame(const SegmentedBody& body);

/// The landmark's coordinates in the frame. Precondition: trunk_frame succeeded.
Vec3 local_landmark(const SegmentedBody& body, const TrunkFrame& frame, body::LandmarkId id);

struct Point2 {
  double x = 0.0, z = 0.0;
};

using PartFilter = std::function<bool(body::Part)>;

/// A skin in the frame of its trunk, ready to be sliced.
class LocalSkin {
 public:
  LocalSkin(const SegmentedBody& body, const TrunkFrame& frame);
  /// Points of the closed curves in which the plane at height y cuts the skin. A curve counts, as a whole, if
  /// at least `least_share` of its length belongs to wanted parts, so that single labels across a border do
  /// not matter. O(#F).
  std::vector<Vec3> slice(double y, const PartFilter& wanted, double least_share = 0.5) const;
  /// Points of the skin with low <= coordinate <= high along `axis` (0 x, 1 y, 2 z).
  std::vector<Vec3> slab(int axis, double low, double high, const PartFilter& wanted) const;

 private:
  const SegmentedBody& body_;
  std::vector<Vec3> local_;
  std::vector<std::array<double, 2>> height_;  ///< #F: lowest and highest corner
};

/// The frame with its y axis through the middle of the pelvis. The perineum's landmark lies on the skin,
/// often well to the front, so that the axis through it leans. The frame is unchanged if the skin there is no
/// closed trunk.
TrunkFrame upright(const SegmentedBody& body, const TrunkFrame& frame);

/// The convex hull, counter-clockwise from the lowest x.
/// Based on: A. M. Andrew. Another efficient algorithm for convex hulls in two dimensions. 1979.
std::vector<Point2> convex_hull(std::vector<Point2> points);

/// A convex curve around a center, as radii over equally spread directions from +x toward +z.
struct Outline {
  static constexpr int kDirections = 256;
  Point2 center;
  std::array<double, kDirections> radius{};
  double at(double angle) const;
};

/// The outline of a hull. Empty slices give radius 0. `center` must lie inside the hull for the outline to be
/// complete.
Outline outline_of(std::span<const Point2> hull, const Point2& center);

/// Angles of `count` points that cut the outline into pieces of equal length; the first is at angle `from`.
std::vector<double> even_angles(const Outline& outline, int count, double from);

double perimeter(const Outline& outline);

}  // namespace bodice::synth
