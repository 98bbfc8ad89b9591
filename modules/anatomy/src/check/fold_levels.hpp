// Where armpits and crotch lie on a body with such limbs: by proportions alone, not by its skin.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include <bodice/body/landmark.hpp>
#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::inline v0_1::anatomy {

/// The landmarks from crown to toes, by number.
inline constexpr std::size_t kMainLandmarks = 13;
using MainLandmarks = std::array<geometry::Vec3, kMainLandmarks>;

inline constexpr std::size_t kArmMeasures = 10, kLegMeasures = 8;

/// The folds between limbs, and what lets expect them: lengths between the landmarks that a skin which has
/// grown together does not move, as fractions of the body's height.
class FoldLevels {
 public:
  explicit FoldLevels(const MainLandmarks& marks);

  /// Whether it is an adult that stands, arms below the shoulders: else a fold moves with pose and age.
  bool known() const { return known_; }
  /// How far an armpit lies below the neck, along the trunk; a fraction of the height.
  double armpit(int side) const;
  double perineum() const;
  /// The measures that the armpit and the crotch are expected by; the first is 1.
  std::array<double, kArmMeasures> arm_measures(int side) const;
  std::array<double, kLegMeasures> leg_measures() const;

 private:
  const geometry::Vec3& at(body::LandmarkId id) const { return marks_[static_cast<std::size_t>(id)]; }
  const geometry::Vec3& at(body::LandmarkId left, int side) const { return at(body::of_side(left, side)); }
  double distance(body::LandmarkId a, body::LandmarkId b) const { return (at(a) - at(b)).norm() / height_; }

  MainLandmarks marks_;
  geometry::Vec3 up_ = geometry::Vec3::UnitY();
  double height_ = 1.0, trunk_ = 0.0;  ///< the height in the mesh's unit; neck to knees as a fraction of it
  bool known_ = false;
};

/// How far the left armpit, the right one and the crotch lie below where they are expected, as fractions of
/// the height; negative: above. Empty where that is not known.
/// With true landmarks of adults the error is .010 for armpits and .011 for the crotch.
std::optional<std::array<double, 3>> folds_below_expected(const std::vector<body::Landmark>& landmarks);

/// The same by what is doubtful: 1 where as far off as whole bodies hardly ever are. 0 if it is not known.
double fold_misfit(const std::vector<body::Landmark>& landmarks);

/// Off by more than this is doubtful.
inline constexpr double kArmpitOff = 0.024, kPerineumOff = 0.018;

}  // namespace bodice::anatomy
