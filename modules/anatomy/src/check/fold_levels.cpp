#include "check/fold_levels.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <coefficients/fold_levels.hpp>

namespace bodice::inline v0_1::anatomy {
namespace {

using body::LandmarkId;
using geometry::Vec3;

/// Cosines to the line from the neck to the middle of the knees: of the lines to both knees, both shins (with
/// their feet) and both thighs of a body that stands. Thighs say least: a crotch too low makes them oblique.
constexpr double kTowardKnee = 0.97, kShin = 0.8, kThigh = 0.75;

/// Crown to neck as a share of the height: adults have less, small children more.
constexpr double kAdultHead = 0.2;

template <std::size_t n>
double dot(const std::array<double, n>& measures, const double (&weights)[n]) {
  return std::inner_product(measures.begin(), measures.end(), weights, 0.0);
}

}  // namespace

FoldLevels::FoldLevels(const MainLandmarks& marks) : marks_(marks) {
  using enum LandmarkId;
  const Vec3 knees = 0.5 * (at(kKneeL) + at(kKneeR)), trunk = at(kNeck) - knees;
  const double shins = 0.5 * ((at(kKneeL) - at(kToeL)).norm() + (at(kKneeR) - at(kToeR)).norm());
  height_ = trunk.norm() + (at(kCrown) - at(kNeck)).norm() + shins;
  if (!(trunk.norm() > 0.0)) return;
  trunk_ = trunk.norm() / height_;
  up_ = trunk.normalized();
  known_ = distance(kCrown, kNeck) < kAdultHead;
  for (int side = 0; side < 2; ++side) {
    const auto along = [&](LandmarkId from, LandmarkId left, double least) {
      const Vec3 bone = at(from) - at(left, side);
      return bone.dot(up_) >= least * bone.norm();
    };
    known_ = known_ && along(kNeck, kKneeL, kTowardKnee) && along(kPerineum, kKneeL, kThigh) &&
             along(body::of_side(kKneeL, side), kToeL, kShin);
    known_ = known_ && (at(kElbowL, side) - at(kNeck)).dot(up_) <= 0.0;
  }
}

double FoldLevels::armpit(int side) const {
  return (at(LandmarkId::kNeck) - at(LandmarkId::kArmpitL, side)).dot(up_) / height_;
}

double FoldLevels::perineum() const {
  return (at(LandmarkId::kNeck) - at(LandmarkId::kPerineum)).dot(up_) / height_;
}

std::array<double, kArmMeasures> FoldLevels::arm_measures(int side) const {
  using enum LandmarkId;
  const LandmarkId elbow = body::of_side(kElbowL, side);
  const double down = (at(elbow) - at(kNeck)).normalized().dot(up_);
  return {1.0,
          down,
          down * down,
          distance(elbow, kNeck),
          distance(elbow, body::of_side(kFingertipL, side)),
          trunk_,
          distance(kCrown, kNeck),
          distance(kElbowL, kElbowR),
          distance(kArmpitL, kArmpitR),
          distance(kKneeL, kKneeR)};
}

std::array<double, kLegMeasures> FoldLevels::leg_measures() const {
  using enum LandmarkId;
  const double apart = distance(kKneeL, kKneeR);
  return {1.0,
          trunk_,
          distance(kCrown, kNeck),
          apart,
          apart * apart,
          0.5 * (distance(kElbowL, kFingertipL) + distance(kElbowR, kFingertipR)),
          distance(kArmpitL, kArmpitR),
          std::abs((at(kKneeL) - at(kKneeR)).dot(up_)) / height_};
}

std::optional<std::array<double, 3>> folds_below_expected(const std::vector<body::Landmark>& landmarks) {
  MainLandmarks marks;
  if (landmarks.size() < marks.size()) return std::nullopt;
  for (std::size_t i = 0; i < marks.size(); ++i) marks[i] = landmarks[i].position;
  const FoldLevels levels(marks);
  if (!levels.known()) return std::nullopt;
  namespace data = coefficients::fold_levels;
  return std::array{levels.armpit(0) - dot(levels.arm_measures(0), data::kArmpit),
                    levels.armpit(1) - dot(levels.arm_measures(1), data::kArmpit),
                    levels.perineum() - dot(levels.leg_measures(), data::kPerineum)};
}

double fold_misfit(const std::vector<body::Landmark>& landmarks) {
  const auto below = folds_below_expected(landmarks);
  if (!below) return 0.0;
  const double armpits = std::max(std::abs((*below)[0]), std::abs((*below)[1]));
  return std::max(armpits / kArmpitOff, std::abs((*below)[2]) / kPerineumOff);
}

}  // namespace bodice::anatomy
