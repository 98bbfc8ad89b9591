// Coordinates on the skin that belong to the body, not to space: distances from its ends and its middle, in
// units of its own lengths. A pose hardly changes them, and the same point has nearly the same coordinates on
// every body.
#pragma once

#include <limits>

#include "coordinates/border.hpp"
#include "coordinates/leg_merge.hpp"

namespace bodice::inline v0_1::anatomy {

/// The margin below which the best vertex is rejected for a vertex in front of it, in deviations. The fold of
/// a heavy seat resembles a perineum, and may fit best. Among 2,100 rig-skinned and made bodies, the five
/// with this error had margins of 2.7 or less, and all others but one 3.2 or more.
inline constexpr float kFoldMargin = 2.9F;

/// A vertex that is nearer to the breastbone along the skin by this fraction of the body size is another
/// candidate of the perineum.
inline constexpr float kInFront = 0.08F;

/// The coordinates of every vertex of a skin, with the lengths and the perineum that they are measured by.
class BodyCoordinates {
 public:
  /// Keeps references to the fields of `tips`. Finds the perineum and measures from it and from the midline.
  BodyCoordinates(const engine::Context& context, const Skin& skin, const BodyExtremities& tips);

  /// side 0: seen from the body's left, 1: from its right.
  CoordinateArray at(std::size_t vertex, int side) const;
  /// Meters that count as one in the distance from an end.
  float unit_of(Coordinate end) const {
    if (end == kFromHead) return size_;
    return end == kOwnHand || end == kOtherHand ? tips_.hands_apart : tips_.feet_apart;
  }
  geometry::Index perineum() const { return perineum_; }
  const geometry::Vec3& perineum_position() const { return perineum_position_; }
  float perineum_mahalanobis() const { return perineum_mahalanobis_; }
  /// The Mahalanobis distance of the best vertex in front of the best one, less that of the best one.
  float perineum_margin() const { return perineum_margin_; }
  /// Whether a vertex lies where the perineum is searched for.
  bool may_be_perineum(std::size_t vertex) const;
  /// The features of the perineum's signature at a vertex, and the measures of the body by which they are
  /// expected.
  std::array<float, 9> perineum_features(std::size_t vertex) const;
  std::array<float, 4> perineum_measures() const;
  /// Whether a vertex lies above the border of the neck.
  bool on_head(std::size_t vertex) const;
  const geodesic::Field& from_front() const { return from_front_; }
  const geodesic::Field& from_back() const { return from_back_; }
  const geodesic::Field& from_perineum() const { return from_perineum_; }
  /// Whether a closed line runs around the middle of the body; none does for instance on welded limbs.
  bool midline_found() const { return midline_found_; }
  /// Length of the path along the skin from the perineum to the crown, meters.
  float trunk_m() const { return trunk_; }
  /// Lengths of the paths from breastbone and back to where the legs merge, meters; those of a usual body
  /// where that is not found.
  float front_to_merge_m() const { return merge_front_; }
  float back_to_merge_m() const { return merge_back_; }
  /// The body size, which is about the stature, meters.
  float size_m() const { return size_; }
  const BodyExtremities& extremities() const { return tips_; }
  const Midline& midline() const { return midline_; }
  const LegMerge& leg_merge() const { return merge_; }
  /// The level at which the loop around the arm widens, meters from the fingertip; 0 if it does not. See
  /// shoulder_level.
  float shoulder_level_m(int side) const { return shoulder_[side]; }

 private:
  void find_middle(const Skin& skin);
  void measure_lengths();
  void find_perineum(const engine::Context& context, const Skin& skin);

  const BodyExtremities& tips_;
  Midline midline_;
  LegMerge merge_;
  geodesic::Field from_front_, from_back_, from_perineum_;
  geometry::Index perineum_ = geometry::kNoIndex;
  geometry::Vec3 perineum_position_ = geometry::Vec3::Zero();
  float perineum_mahalanobis_ = 0.0F;
  float perineum_margin_ = std::numeric_limits<float>::infinity();
  float size_ = 0.0F;
  float trunk_ = 0.0F, merge_front_ = 0.0F, merge_back_ = 0.0F;
  std::array<float, 2> head_to_hand_{}, head_to_foot_{}, hand_to_foot_{}, shoulder_{};
  bool midline_found_ = true;
};

}  // namespace bodice::anatomy
