#include "check/fused_limbs.hpp"

#include "landmarks/landmark_table.hpp"

namespace bodice::inline v0_1::anatomy {
namespace {

/// A hand welded to a thigh makes the path from hand to foot shorter than this, and legs welded together the
/// path from foot to foot; fractions of the body size. On 1,600 whole bodies the shortest paths are 1.06 and
/// .96.
constexpr double kHandToFoot = 1.03, kFootToFoot = 0.93;
/// The number of landmarks in doubt (the neck, which no weld of limbs is near, counts for two) from which
/// limbs are fused. Then nine tenths of the skin or less, mostly two thirds, get the right part; with fewer,
/// mostly more.
constexpr int kSpoiled = 4;

int landmarks_in_doubt(const CheckedLandmarks& landmarks) {
  int count = 0;
  for_each_landmark([&](const LandmarkKind& kind, int side) {
    const LandmarkId id = body::of_side(kind.id, side);
    const double difference = landmarks.differences[static_cast<std::size_t>(id)][0];
    if (landmarks.marks[id].mark.confidence < kUncertain || difference > kind.checks[0].most)
      count += kind.doubt;
  });
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
                                               const CheckedLandmarks& landmarks) {
  if (skin.handles < 1 || landmarks_in_doubt(landmarks) < kSpoiled) return std::nullopt;
  return engine::Error{engine::ErrorCode::kUnusableGeometry,
                       "The skin is fused where " + what_meets(coordinates) +
                           ", so that the parts of the body cannot be distinguished.",
                       "Separate what touches, or give a pose with the arms and legs apart."};
}

}  // namespace bodice::anatomy
