#include "check/unequal_arms.hpp"

#include <array>
#include <cmath>
#include <string>

#include "check/fold_levels.hpp"
#include "check/named_folds.hpp"

namespace bodice::inline v0_1::anatomy {
namespace {

using body::LandmarkId;

/// The differences of arms, from elbow to fingertip and from armpit to elbow, that correct scans hardly
/// exceed; fractions of the stature. An elbow or an armpit 3 % off on one side made them 0.022 and more.
constexpr double kForearms = 0.0215, kUpperArms = 0.0205;
/// The same of the distances from neck to armpits: 0.024 at most on correct scans, and 0.005 in truth. A wall
/// that led into the trunk on one side made it 0.035.
constexpr double kCollars = 0.028;

constexpr std::array<NamedFold, 2> kElbows = {
    {{LandmarkId::kElbowL, body::Part::kForearmL, "elbow-uncertain", "the left elbow"},
     {LandmarkId::kElbowR, body::Part::kForearmR, "elbow-uncertain", "the right elbow"}}};

const body::Landmark& at(const Anatomy& anatomy, LandmarkId left, int side) {
  return anatomy.landmarks[static_cast<std::size_t>(body::of_side(left, side))];
}

/// How much longer the left side is from one landmark to the next, as a fraction of the stature.
double left_longer(const Anatomy& anatomy, LandmarkId from, LandmarkId to) {
  const auto length = [&](int side) {
    const LandmarkId start = from == LandmarkId::kNeck ? from : body::of_side(from, side);
    return (anatomy.landmarks[static_cast<std::size_t>(start)].position - at(anatomy, to, side).position)
        .norm();
  };
  return (length(0) - length(1)) / anatomy.stature_m;
}

/// The side of the armpit that is farther from where it is expected; where that is not known, of the one that
/// looks less like one.
std::size_t worse_armpit(const Anatomy& anatomy) {
  if (const auto below = folds_below_expected(anatomy.landmarks))
    return std::abs((*below)[0]) < std::abs((*below)[1]);
  return at(anatomy, LandmarkId::kArmpitL, 0).confidence > at(anatomy, LandmarkId::kArmpitL, 1).confidence;
}

std::string lies(double differ, const char* what) {
  return "where one " + std::string(what) + " is " + std::to_string(std::lround(1e3 * std::abs(differ))) +
         " thousandths of the stature longer than the other.";
}

}  // namespace

void doubt_unequal_arms(Anatomy& anatomy) {
  constexpr const char* kShownBy = ", seen from all sides, shows it.";
  const double forearms = left_longer(anatomy, LandmarkId::kElbowL, LandmarkId::kFingertipL);
  if (std::abs(forearms) > kForearms)
    for (const NamedFold& elbow : kElbows)
      doubt_fold(elbow, lies(forearms, "forearm with its hand"), kShownBy, anatomy);
  const double upper_arms = left_longer(anatomy, LandmarkId::kArmpitL, LandmarkId::kElbowL);
  const double collars = left_longer(anatomy, LandmarkId::kNeck, LandmarkId::kArmpitL);
  const bool arms_differ = std::abs(upper_arms) > kUpperArms;
  if (!arms_differ && std::abs(collars) <= kCollars) return;
  const NamedFold& armpit = kNamedFolds[worse_armpit(anatomy)];
  if (in_doubt(anatomy, armpit)) return;
  if (arms_differ)
    doubt_fold(armpit, lies(upper_arms, "upper arm"), kShownBy, anatomy);
  else
    doubt_fold(armpit, lies(collars, "line from neck to armpit"), kShownBy, anatomy);
}

}  // namespace bodice::anatomy
