// The skin of a figure in its rest pose, as an implicit surface that blends along the skeleton's tree only. A
// region is made of its own lofts and those of its neighbors in the tree, so that limbs that come close to
// each other never fuse.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "figure/figure.hpp"
#include "figure/loft.hpp"

namespace bodice::inline v0_1::synth {

/// A region of the skin. The crotch is the floor of the trunk, without the legs. Digits are index, middle,
/// ring and little finger and thumb, first the left ones.
enum class Region : std::uint8_t { kTrunk, kCrotch, kHead, kArmL, kArmR, kLegL, kLegR, kDigits };
inline constexpr int kDigitsPerHand = 5;
inline constexpr int kRegionCount = static_cast<int>(Region::kDigits) + 2 * kDigitsPerHand;

constexpr Region digit_region(int side, int digit) {
  return static_cast<Region>(static_cast<int>(Region::kDigits) + side * kDigitsPerHand + digit);
}
constexpr Region region_of_side(Region left, int side) {
  return static_cast<Region>(static_cast<int>(left) + side);
}
constexpr bool is_digit(Region region) {
  return region >= Region::kDigits;
}
/// The side of a region: 0 left, 1 right, -1 for trunk and head.
constexpr int side_of(Region region) {
  if (is_digit(region))
    return (static_cast<int>(region) - static_cast<int>(Region::kDigits)) / kDigitsPerHand;
  if (region < Region::kArmL) return -1;
  return region == Region::kArmL || region == Region::kLegL ? 0 : 1;
}

constexpr Region mirrored(Region region) {
  const int side = side_of(region);
  if (side < 0) return region;
  const int step = is_digit(region) ? kDigitsPerHand : 1;
  return static_cast<Region>(static_cast<int>(region) + (side == 0 ? step : -step));
}

/// The origin, direction and length of a digit in the rest pose.
struct Digit {
  Vec3 base, along, out, front;
  double length = 0.0, radius = 0.0;
};
Digit digit_of(const Figure& figure, int side, int digit);

class Flesh {
 public:
  explicit Flesh(const Figure& figure);

  /// Approximately the signed distance to the region's skin, negative inside.
  double value(Region region, const Vec3& p) const;

  /// The same for the region's own lofts alone.
  double own_value(Region region, const Vec3& p) const;

  /// Moves p to the skin by a few damped Newton steps. `normal` receives the outward unit normal there.
  Vec3 project(Region region, Vec3 p, int steps, Vec3* normal = nullptr) const;

 private:
  struct Primitive {
    Loft loft;
    double blend;  ///< radius of the smooth union with the primitives before
  };
  class Deciding;

  void add(Region region, Loft loft, double blend);
  void add_trunk(const Figure& figure);
  void add_head(const Figure& figure);
  void add_arm(const Figure& figure, int side);
  void add_leg(const Figure& figure, int side);
  void link_regions();
  void link_right_half();
  const std::vector<int>& visible_at(Region region, const Vec3& p) const;
  double united(std::span<const int> primitives, Region region, const Vec3& p, Deciding* deciding) const;
  Vec3 gradient(Region region, const Vec3& p, double value, const Deciding& deciding) const;

  std::vector<Primitive> primitives_;
  std::array<std::vector<int>, kRegionCount> own_;      ///< primitives of each region
  std::array<std::vector<int>, kRegionCount> visible_;  ///< its own and its neighbors', in build order
  /// visible_ for points of the right half. The union folds in mirrored order, so that the body is its own
  /// mirror image to the last bit.
  std::array<std::vector<int>, kRegionCount> visible_right_;
};

}  // namespace bodice::synth
