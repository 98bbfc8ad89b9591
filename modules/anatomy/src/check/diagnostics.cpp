#include "check/diagnostics.hpp"

#include <cmath>

#include "check/fused_limbs.hpp"

namespace bodice::anatomy {
namespace {

using engine::Warning;

/// Above this the five ends lie at unusual distances, in deviations.
constexpr double kFairMisfit = 2.0;
constexpr double kUncertainSides = 0.3;
/// Left and right differ by more than poses explain, of the stature.
constexpr double kAsymmetry = 0.12;

void check_surface(const Skin& skin, std::vector<Warning>& warnings) {
  if (skin.open_edges > 0)
    warnings.push_back({"holes", "", std::to_string(skin.open_edges) + " edges of the skin border a hole.",
                        "Close the holes if distances around them matter."});
  if (skin.pieces > 1)
    warnings.push_back(
        {"extra-pieces", "",
         std::to_string(skin.pieces - 1) +
             " pieces are not connected to the body and take the part of the closest point of the skin.",
         "Remove eyes, clothes or scan debris to leave them out."});
  const int count = skin.handles;
  if (count > 0)
    warnings.push_back(
        {"limbs-fused", "",
         "The skin has " + std::to_string(count) +
             " handles: parts that touch are welded to each other, so ways along it are cut short.",
         "Separate what touches, or give a pose with arms and legs apart."});
}

void check_welds(const BodyCoordinates& coordinates, std::vector<Warning>& warnings) {
  constexpr std::array<const char*, 2> forearm{"forearm_l", "forearm_r"};
  for (int side = 0; side < 2; ++side)
    if (hand_fused_to_leg(coordinates, side))
      warnings.push_back(
          {"hand-fused-to-leg", forearm[side],
           "The way along the skin from this hand to its foot is too short.",
           "Separate the hand from the thigh, or give a pose with the arms away from the body."});
  if (legs_fused(coordinates))
    warnings.push_back({"legs-fused", "thigh_l", "The way along the skin from foot to foot is too short.",
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

void check_places(const Landmarks& marks, std::vector<Warning>& warnings) {
  const auto uncertain = [&](double confidence, const char* code, const char* part, const char* what) {
    if (confidence < kUncertain)
      warnings.push_back({code, part, std::string("The ") + what + " could not be placed with confidence.",
                          "Check this border in the result."});
  };
  uncertain(marks.perineum_confidence, "perineum-uncertain", "thigh_l", "perineum");
  uncertain(marks.armpit_confidence[0], "armpit-uncertain", "upper_arm_l", "left armpit");
  uncertain(marks.armpit_confidence[1], "armpit-uncertain", "upper_arm_r", "right armpit");
  uncertain(marks.neck.confidence, "neck-uncertain", "head", "neck");
}

/// Two independent ways that contradict each other: the first is used, and the reader is told.
void check_second_ways(const CrossCheck& second, std::vector<Warning>& warnings) {
  const auto differ = [&](double apart, double most, const char* code, const char* part, const char* text) {
    if (apart > most)
      warnings.push_back(
          {code, part, text, "Check this border in the result; welded or touching parts often cause it."});
  };
  differ(second.neck, kMaxNeckDifference, "neck-disagrees", "head",
         "The neck's border and its narrowest place lie far from each other.");
  differ(second.perineum, kMaxPerineumDifference, "perineum-disagrees", "thigh_l",
         "The perineum and the place where the legs join along the skin lie far from each other.");
  differ(second.crown, kMaxCrownDifference, "crown-disagrees", "head",
         "The top of the head and the place of the head that is farthest from the perineum lie apart.");
  constexpr std::array<const char*, 2> upper_arm{"upper_arm_l", "upper_arm_r"},
      forearm{"forearm_l", "forearm_r"}, thigh{"thigh_l", "thigh_r"}, calf{"calf_l", "calf_r"};
  for (int side = 0; side < 2; ++side) {
    differ(second.armpit[side], kMaxArmpitDifference, "armpit-disagrees", upper_arm[side],
           "The armpit and the place where the arm widens into the trunk lie far from each other.");
    differ(second.elbow[side], kMaxElbowDifference, "elbow-disagrees", upper_arm[side],
           "The elbow's border and the bend or the middle of the arm lie far from each other.");
    differ(second.fingertip[side], kMaxFingertipDifference, "fingertip-disagrees", forearm[side],
           "The fingertip and the place of the hand that is farthest from the trunk lie apart.");
    differ(second.knee[side], kMaxKneeDifference, "knee-disagrees", thigh[side],
           "The knee's border and the bend or the middle of the leg lie far from each other.");
    differ(second.toe[side], kMaxToeDifference, "toe-disagrees", calf[side],
           "The tip of the foot and the place of the foot that is farthest from the trunk lie apart.");
  }
}

/// What the way along the skin adds to a survey's straight measure (the foot, mostly), and how far builds,
/// poses and the estimate of the stature spread; of the stature.
constexpr double kFootAlongSkin = 0.07, kLegSpread = 0.08, kArmSpread = 0.08;

/// The survey is a cross-check only: children and cartoon figures differ from it and are still understood.
void check_proportions(const BodyExtremities& tips, const Landmarks& marks,
                       const body::ProportionProfile& profile, double stature,
                       std::vector<Warning>& warnings) {
  const body::Proportions survey = profile.either();
  if (!(survey.crotch_height > 0.0) || !(stature > 0.0)) return;
  constexpr std::array<const char*, 2> thigh{"thigh_l", "thigh_r"}, upper_arm{"upper_arm_l", "upper_arm_r"};
  const auto compare = [&](double measured_m, double expected, double spread, const char* part,
                           const char* what) {
    if (std::abs(measured_m / stature - expected) > spread)
      warnings.push_back(
          {"unusual-proportions", part,
           std::string("The ") + what + " is unusual for a body of profile " + profile.name + ".",
           "Nothing to do for a child or a stylised figure; else check the landmarks."});
  };
  for (int side = 0; side < 2; ++side) {
    compare(static_cast<double>((*tips.from_foot[side])[marks.perineum]),
            survey.crotch_height + kFootAlongSkin, kLegSpread, thigh[side], "length of this leg");
    compare(static_cast<double>((*tips.from_hand[side])[marks.armpit[side]]), survey.fingertip_to_armpit,
            kArmSpread, upper_arm[side], "length of this arm");
  }
}

}  // namespace

std::vector<Warning> diagnose(const Skin& skin, const Extremities& found, const Sides& sides,
                              const BodyCoordinates& coordinates, const Landmarks& marks,
                              const CrossCheck& second, const body::ProportionProfile& profile,
                              double stature) {
  std::vector<Warning> warnings;
  const auto size = static_cast<double>(coordinates.size_m());
  check_surface(skin, warnings);
  check_welds(coordinates, warnings);
  check_symmetry(coordinates.extremities(), size, warnings);
  check_places(marks, warnings);
  check_second_ways(second, warnings);
  check_proportions(coordinates.extremities(), marks, profile, stature, warnings);
  if (found.mahalanobis > kFairMisfit)
    warnings.push_back({"unusual-body", "", "The ends of the body lie at unusual distances from each other.",
                        "Check the landmarks: welded, missing or very long limbs change these distances."});
  if (sides.confidence < kUncertainSides)
    warnings.push_back({"sides-uncertain", "", "Left and right could not be told apart with confidence.",
                        "Check that the triangles are wound outwards and the feet are whole."});
  if (!coordinates.midline_found())
    warnings.push_back({"midline-not-found", "torso_ml", "No closed line runs around the middle of the body.",
                        "Close holes at chest and back, or separate welded limbs."});
  return warnings;
}

}  // namespace bodice::anatomy
