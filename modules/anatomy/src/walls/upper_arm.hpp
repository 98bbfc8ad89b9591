// Where an upper arm lies that the slices of a body show as a part of the trunk.
#pragma once

#include <optional>

#include "walls/slices.hpp"

namespace bodice::inline v0_1::anatomy {

/// A straight upper arm: what lies within a radius of its axis, and all that lies outward of that.
class UpperArm {
 public:
  /// The arm that hangs from the side of the shoulder to the middle `end` of its cross-section in slice
  /// `last`. Empty where that is the middle of the trunk.
  static std::optional<UpperArm> hanging(const Slices& slices, std::size_t last, const SlicePoint& end);

  /// The arm of a bent elbow. The forearm ends at `end`, in front of the arm's axis, and goes on to it for
  /// the thickness of an arm. In the slices from `low` to `high` nothing lies farther to the side of the
  /// body. Empty where no side can be made out.
  static std::optional<UpperArm> bent(const Slices& slices, std::size_t low, std::size_t high,
                                      const SlicePoint& end);

  /// Whether a node of a slice is of the arm.
  bool holds(std::size_t slice, std::size_t i) const;

  double radius() const { return radius_; }

 private:
  UpperArm(const Slices& slices, const SlicePoint& center) : slices_(&slices), center_(center) {}

  bool set_side(const SlicePoint& end);
  void fit_axis(std::size_t low, std::size_t high);
  double along(std::size_t i, const SlicePoint& from, const SlicePoint& direction) const;
  double reach(std::size_t slice) const;
  SlicePoint across() const { return {-outward_[1], outward_[0]}; }

  const Slices* slices_;
  SlicePoint center_;            ///< the middle of the trunk at the shoulders
  SlicePoint outward_{};         ///< unit, from the trunk to the arm
  SlicePoint on_axis_{}, by_{};  ///< a point of the axis, and its offset from slice to slice
  double at_ = 0.0;              ///< the slice of that point
  double radius_ = 0.0;
  SlicePoint forearm_{};   ///< where a bent forearm leaves the slices
  std::size_t elbow_ = 0;  ///< below this slice the arm reaches to there
};

}  // namespace bodice::anatomy
