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

int places_in_doubt(const Landmarks& marks, const SecondWays& second) {
  int count = 2 * doubted(marks.neck.confidence, second.neck, kNeckApart) +
              doubted(marks.perineum_confidence, second.perineum, kPerineumApart);
  for (int side = 0; side < 2; ++side)
    count += doubted(marks.armpit_confidence[side], second.armpit[side], kArmpitApart) +
             doubted(marks.elbow[side].confidence, second.elbow[side], kElbowApart) +
             doubted(marks.knee[side].confidence, second.knee[side], kKneeApart);
  return count;
}

std::string what_meets(const BodyCoordinates& coordinates) {
  const bool hands = hand_meets_leg(coordinates, 0) || hand_meets_leg(coordinates, 1);
  if (hands && legs_meet(coordinates)) return "a hand touches a leg and where the legs touch";
  if (hands) return "a hand touches a leg";
  return legs_meet(coordinates) ? "the legs touch" : "limbs touch";
}

}  // namespace

bool hand_meets_leg(const BodyCoordinates& coordinates, int side) {
  const BodyEnds& ends = coordinates.ends();
  return static_cast<double>((*ends.from_hand[side])[ends.foot[side]]) <
         kHandToFoot * static_cast<double>(coordinates.size_m());
}

bool legs_meet(const BodyCoordinates& coordinates) {
  return static_cast<double>(coordinates.ends().feet_apart) <
         kFootToFoot * static_cast<double>(coordinates.size_m());
}

std::optional<engine::Error> spoiled_by_welds(const Skin& skin, const BodyCoordinates& coordinates,
                                              const Landmarks& marks, const SecondWays& second) {
  if (skin.handles < 1 || places_in_doubt(marks, second) < kSpoilt) return std::nullopt;
  return engine::Error{engine::ErrorCode::kUnusableGeometry,
                       "The skin is fused where " + what_meets(coordinates) +
                           ", so that the parts of the body cannot be told apart.",
                       "Separate what touches, or give a pose with the arms and legs apart."};
}

}  // namespace bodice::anatomy
