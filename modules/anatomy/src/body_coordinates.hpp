// Coordinates on the skin that belong to the body, not to space: distances from its ends and its middle, in
// units of its own lengths. A pose hardly changes them, and the same place has nearly the same coordinates on
// every body.
#pragma once

#include "calibration.hpp"
#include "leg_merge.hpp"

namespace bodice::anatomy {

class BodyCoordinates {
 public:
  /// Keeps references to the fields of `ends`. Finds the perineum and measures from it and from the midline.
  BodyCoordinates(const engine::Context& context, const Skin& skin, const BodyEnds& ends);

  /// side 0: seen from the body's left, 1: from its right.
  CoordinateArray at(std::size_t vertex, int side) const;
  geometry::Index perineum() const { return perineum_; }
  const geometry::Vec3& perineum_place() const { return perineum_place_; }
  float perineum_misfit() const { return perineum_misfit_; }
  /// Above the border of the neck.
  bool on_head(std::size_t vertex) const;
  const geodesic::Field& from_front() const { return from_front_; }
  const geodesic::Field& from_back() const { return from_back_; }
  const geodesic::Field& from_perineum() const { return from_perineum_; }
  /// False where no closed line runs around the middle, for instance on welded limbs.
  bool midline_found() const { return midline_found_; }
  /// About the stature.
  float size_m() const { return size_; }
  const BodyEnds& ends() const { return ends_; }
  const Midline& midline() const { return midline_; }
  const LegMerge& leg_merge() const { return merge_; }
  /// Where the loop around the arm widens, metres from the fingertip; 0 if it does not. See shoulder_level.
  float shoulder_level_m(int side) const { return shoulder_[side]; }

 private:
  void find_middle(const Skin& skin);
  void measure_lengths();
  void find_perineum(const engine::Context& context, const Skin& skin);

  const BodyEnds& ends_;
  Midline midline_;
  LegMerge merge_;
  geodesic::Field from_front_, from_back_, from_perineum_;
  geometry::Index perineum_ = geometry::kNoIndex;
  geometry::Vec3 perineum_place_ = geometry::Vec3::Zero();
  float perineum_misfit_ = 0.0F;
  float size_ = 0.0F;
  float trunk_ = 0.0F;  ///< perineum to crown along the skin
  std::array<float, 2> head_to_hand_{}, head_to_foot_{}, hand_to_foot_{}, shoulder_{};
  bool midline_found_ = true;
};

}  // namespace bodice::anatomy
