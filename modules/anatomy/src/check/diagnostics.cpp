#include "check/diagnostics.hpp"

#include <cmath>

#include "check/fused_limbs.hpp"
#include "check/hanging_hair.hpp"
#include "check/landmark_warnings.hpp"

namespace bodice::inline v0_1::anatomy {
namespace {

using engine::Warning;

/// The Mahalanobis distance above which the five extremities lie at unusual distances from each other.
constexpr double kFairDistance = 2.0;
constexpr double kUncertainSides = 0.3;
/// Left and right differ by more than poses explain; a fraction of the stature.
constexpr double kAsymmetry = 0.12;

void check_surface(const Skin& skin, std::vector<Warning>& warnings) {
  if (skin.open_edges > 0)
    warnings.push_back(engine::note("holes", "",
                                    std::to_string(skin.open_edges) + " edges of the skin border a hole.",
                                    "Close the holes if distances around them matter."));
  if (skin.pieces > 1)
    warnings.push_back(engine::note(
        "extra-pieces", "",
        std::to_string(skin.pieces - 1) +
            " pieces are not connected to the body and take the part of the closest point of the skin.",
        "Remove eyes, clothes or scan debris to leave them out."));
  const int count = skin.handles;
  if (count > 0)
    warnings.push_back(
        {"limbs-fused", "",
         "The skin has " + std::to_string(count) +
             " handles: parts that touch are welded to each other, so that paths along it are cut short.",
         "Separate what touches, or give a pose with arms and legs apart."});
}

void check_welds(const BodyCoordinates& coordinates, std::vector<Warning>& warnings) {
  constexpr std::array<const char*, 2> forearm{"forearm_l", "forearm_r"};
  for (int side = 0; side < 2; ++side)
    if (hand_fused_to_leg(coordinates, side))
      warnings.push_back(
          {"hand-fused-to-leg", forearm[side],
           "The path along the skin from this hand to its foot is too short.",
           "Separate the hand from the thigh, or give a pose with the arms away from the body."});
  if (legs_fused(coordinates))
    warnings.push_back({"legs-fused", "thigh_l", "The path along the skin from foot to foot is too short.",
                        "Separate the legs, or give a pose with the legs apart."});
}

void check_symmetry(const BodyExtremities& tips, double size, std::vector<Warning>& warnings) {
  const auto differ = [&](const auto& vertex) {
    return std::abs(static_cast<double>((*tips.from_head)[vertex[0]]) -
                    static_cast<double>((*tips.from_head)[vertex[1]])) > kAsymmetry * size;
  };
  if (differ(tips.hand))
    warnings.push_back({"arms-differ", "upper_arm_l", "One arm is much longer along the skin than the other.",
                        "Check for a missing hand or an arm welded to the body."});
  if (differ(tips.foot))
    warnings.push_back({"legs-differ", "thigh_l", "One leg is much longer along the skin than the other.",
                        "Check for a missing foot or legs welded together."});
}

/// What the path along the skin adds to a survey's straight measure (the foot, mostly), and how far builds,
/// poses and the estimate of the stature spread; fractions of the stature.
constexpr double kFootAlongSkin = 0.07, kLegSpread = 0.08, kArmSpread = 0.08;

/// The survey is a cross-check only: children and cartoon figures differ from it and are still segmented
/// well.
void check_proportions(const BodyExtremities& tips, const Landmarks& marks,
                       const body::ProportionProfile& profile, double stature_m,
                       std::vector<Warning>& warnings) {
  const body::Proportions survey = profile.either();
  if (!(survey.crotch_height > 0.0) || !(stature_m > 0.0)) return;
  constexpr std::array<const char*, 2> thigh{"thigh_l", "thigh_r"}, upper_arm{"upper_arm_l", "upper_arm_r"};
  const auto compare = [&](double measured_m, double expected, double spread, const char* part,
                           const char* what) {
    if (std::abs(measured_m / stature_m - expected) > spread)
      warnings.push_back(
          {"unusual-proportions", part,
           std::string("The ") + what + " is unusual for a body of profile " + profile.name + ".",
           "Nothing to do for a child or a stylised figure; else check the landmarks."});
  };
  for (int side = 0; side < 2; ++side) {
    compare(static_cast<double>((*tips.from_foot[side])[marks[LandmarkId::kPerineum].mark.vertex]),
            survey.crotch_height + kFootAlongSkin, kLegSpread, thigh[side], "length of this leg");
    compare(static_cast<double>(
                (*tips.from_hand[side])[marks[body::of_side(LandmarkId::kArmpitL, side)].mark.vertex]),
            survey.fingertip_to_armpit, kArmSpread, upper_arm[side], "length of this arm");
  }
}

}  // namespace

std::vector<Warning> diagnose(const Findings& found, const body::ProportionProfile& profile,
                              double stature_m) {
  std::vector<Warning> warnings;
  const BodyCoordinates& coordinates = found.coordinates;
  const auto size = static_cast<double>(coordinates.size_m());
  check_surface(found.skin, warnings);
  check_welds(coordinates, warnings);
  check_symmetry(coordinates.extremities(), size, warnings);
  warn_of_landmarks(found.landmarks, warnings);
  check_proportions(coordinates.extremities(), found.landmarks.marks, profile, stature_m, warnings);
  if (found.extremities.mahalanobis > kFairDistance)
    warnings.push_back({"unusual-body", "",
                        "The extremities of the body lie at unusual distances from each other.",
                        "Check the landmarks: welded, missing or very long limbs change these distances."});
  if (found.sides.confidence < kUncertainSides)
    warnings.push_back({"sides-uncertain", "", "Left and right could not be distinguished with confidence.",
                        "Check that the triangles are wound outwards and the feet are whole."});
  const Landmarks& marks = found.landmarks.marks;
  if (marks.head_profile && covers_nape(found.skin, coordinates, marks))
    warnings.push_back({"nape-covered", "head",
                        "Something covers the nape, such as hair that hangs down: it counts as skin.",
                        "For the body alone, scan it with the hair tied up or under a cap."});
  if (!coordinates.midline_found())
    warnings.push_back({"midline-not-found", "torso_ml", "No closed line runs around the middle of the body.",
                        "Close holes at chest and back, or separate welded limbs."});
  return warnings;
}

}  // namespace bodice::anatomy
