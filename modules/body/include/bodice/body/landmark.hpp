#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include <bodice/geometry/types.hpp>

namespace bodice::inline v0_1::body {

/// The points of a body that are found by name; of a pair the left one comes first.
enum class LandmarkId : std::uint8_t {
  kCrown,
  kNeck,
  kFingertipL,
  kFingertipR,
  kElbowL,
  kElbowR,
  kArmpitL,
  kArmpitR,
  kPerineum,
  kKneeL,
  kKneeR,
  kToeL,
  kToeR,
  kNeckFront,
  kNeckBack,
  kNeckSideL,
  kNeckSideR,
  kShoulderL,
  kShoulderR,
  kBustL,
  kBustR,
  kUnderbust,
  kWaist,
  kHip,
  kWristL,
  kWristR,
  kAnkleL,
  kAnkleR,
};

/// A name for each value of LandmarkId, in the same order.
inline constexpr auto kLandmarkNames = std::to_array<std::string_view>(
    {"crown",     "neck",        "fingertip_l", "fingertip_r", "elbow_l",    "elbow_r", "armpit_l",
     "armpit_r",  "perineum",    "knee_l",      "knee_r",      "toe_l",      "toe_r",   "neck_front",
     "neck_back", "neck_side_l", "neck_side_r", "shoulder_l",  "shoulder_r", "bust_l",  "bust_r",
     "underbust", "waist",       "hip",         "wrist_l",     "wrist_r",    "ankle_l", "ankle_r"});

inline constexpr int kLandmarkCount = static_cast<int>(kLandmarkNames.size());

/// The name of a landmark in files and messages, such as "fingertip_l".
constexpr std::string_view name(LandmarkId id) {
  return kLandmarkNames[static_cast<int>(id)];
}

/// The landmark that is meant on a side: side 0 gives `left` itself, side 1 its right counterpart.
constexpr LandmarkId of_side(LandmarkId left, int side) {
  return static_cast<LandmarkId>(static_cast<int>(left) + side);
}

/// A named point of a body with a confidence. The neck and the joints of limbs lie inside, as do underbust,
/// waist and hip, which are the centroids of the trunk's girths there.
struct Landmark {
  LandmarkId id = LandmarkId::kCrown;
  geometry::Vec3 position = geometry::Vec3::Zero();  ///< in the coordinates of the skin, meters
  geometry::Index vertex = geometry::kNoIndex;       ///< nearest vertex of the skin
  double confidence = 0.0;                           ///< 0 (not found) to 1
};

}  // namespace bodice::body
