// The outline of the head from the forehead over the crown to the back, and hair that stands off it.
#pragma once

#include <optional>
#include <vector>

#include "coordinates/head_ball.hpp"
#include "landmarks/base/loop.hpp"

namespace bodice::inline v0_1::anatomy {

/// The outline of a head in its plane of symmetry.
class HeadProfile {
 public:
  /// A point of the plane: forward and up from the middle of the head, fractions of the body size.
  using Point = Eigen::Vector2d;

  /// O(#F). Preconditions: the neck was found, and the head has a radius.
  HeadProfile(const Skin& skin, const BodyCoordinates& coordinates, const Ball& head, const Loop& neck);

  const Ball& head() const { return head_; }
  const geometry::Vec3& middle() const { return head_.center; }

  /// Unit vectors: from the neck to the middle of the head, and at right angles to that.
  const geometry::Vec3& up() const { return up_; }
  const geometry::Vec3& across() const { return across_; }

  /// A position on the plane of symmetry.
  Point on_plane(const geometry::Vec3& position) const;

  /// The back of the head; empty where its outline has no point.
  std::optional<Point> back() const {
    return outline_.empty() ? std::nullopt : std::optional(outline_.front());
  }

  /// The deepest hollow of the outline, a fraction of the body size: how far the skin lies below a band that
  /// is stretched over it. A bare head bulges everywhere; hair that is tied up leaves a hollow before it.
  double hollow() const { return hollow_; }

  /// Whether a position lies behind a hollow that no bare head has, and before the next such one, if any.
  bool is_on_hair(const geometry::Vec3& position) const;

  /// Positions on the outline from the first such hollow to the forehead.
  std::vector<geometry::Vec3> before_hair() const;

 private:
  Ball head_;
  geometry::Vec3 up_, across_;
  double size_m_;
  std::vector<Point> outline_;  // from the back to the forehead
  double hollow_ = 0.0;
  std::vector<std::size_t> deep_hollows_;  // indices of outline points in hollows that no bare head has
};

/// Outlines of 150 made and 34 real heads have no hollow beyond .003 of the body size, those of noisy or
/// closed scans .0036 at most, and those with a bun .0064 at least.
inline constexpr double kMaxHollow = 0.005;

/// The profile of a head; empty where its neck was not found or it has no radius. O(#F).
std::optional<HeadProfile> head_profile(const Skin& skin, const BodyCoordinates& coordinates,
                                        const Ball& head, const Loop& neck);

}  // namespace bodice::anatomy
