#include "check/fused_limbs.hpp"

namespace bodice::anatomy {
namespace {

/// A hand welded to a thigh makes the way from hand to foot shorter than this, of the size; legs welded
/// together the way from foot to foot. Of 1,600 whole bodies the shortest ways are 1.06 and .96.
constexpr double kHandToFoot = 1.03, kFootToFoot = 0.93;
/// With so many places in doubt (the neck, which no weld of limbs is near, for two), nine tenths of the skin
/// or less, mostly two thirds, get the right part; with fewer, mostly more.
constexpr int kSpoilt = 4;

bool doubted(double confidence, double apart, double contradiction) {
  return confidence < kUncertain || apart > contradiction;
}

int places_in_doubt(const Landmarks& marks, const CrossCheck& second) {
  int count = 2 * doubted(marks.neck.confidence, second.neck, kMaxNeckDifference) +
              doubted(marks.perineum_confidence, second.perineum, kMaxPerineumDifference);
  for (int side = 0; side < 2; ++side)
    count += doubted(marks.armpit_confidence[side], second.armpit[side], kMaxArmpitDifference) +
             doubted(marks.elbow[side].confidence, second.elbow[side], kMaxElbowDifference) +
             doubted(marks.knee[side].confidence, second.knee[side], kMaxKneeDifference);
  return count;
}

std::string what_meets(const BodyCoordinates& coordinates) {
  const bool hands = hand_fused_to_leg(coordinates, 0) || hand_fused_to_leg(coordinates, 1);
  if (hands && legs_fused(coordinates)) return "a hand touches a leg and where the legs touch";
  if (hands) return "a hand touches a leg";
  return legs_fused(coordinates) ? "the legs touch" : "limbs touch";
}

}  // namespace

bool hand_fused_to_leg(const BodyCoordinates& coordinates, int side) {
  const BodyExtremities& tips = coordinates.extremities();
  return static_cast<double>((*tips.from_hand[side])[tips.foot[side]]) <
         kHandToFoot * static_cast<double>(coordinates.size_m());
}

bool legs_fused(const BodyCoordinates& coordinates) {
  return static_cast<double>(coordinates.extremities().feet_apart) <
         kFootToFoot * static_cast<double>(coordinates.size_m());
}

std::optional<engine::Error> fused_limbs_error(const Skin& skin, const BodyCoordinates& coordinates,
                                               const Landmarks& marks, const CrossCheck& second) {
  if (skin.handles < 1 || places_in_doubt(marks, second) < kSpoilt) return std::nullopt;
  return engine::Error{engine::ErrorCode::kUnusableGeometry,
                       "The skin is fused where " + what_meets(coordinates) +
                           ", so that the parts of the body cannot be told apart.",
                       "Separate what touches, or give a pose with the arms and legs apart."};
}

}  // namespace bodice::anatomy
