#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include <bodice/geometry/types.hpp>

namespace bodice::body {

/// A landmark's name.
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
};

inline constexpr int kLandmarkCount = 13;

inline constexpr std::array<std::string_view, kLandmarkCount> kLandmarkNames = {
    "crown",    "neck",     "fingertip_l", "fingertip_r", "elbow_l", "elbow_r", "armpit_l",
    "armpit_r", "perineum", "knee_l",      "knee_r",      "toe_l",   "toe_r"};

constexpr std::string_view name(LandmarkId id) {
  return kLandmarkNames[static_cast<int>(id)];
}

/// A named point of the body: on the skin, or for neck, elbows and knees the centroid of their girth.
struct Landmark {
  LandmarkId id = LandmarkId::kCrown;
  geometry::Vec3 position = geometry::Vec3::Zero();  ///< in the coordinates of the skin, meters
  geometry::Index vertex = geometry::kNoIndex;       ///< nearest vertex of the skin
  double confidence = 0.0;                           ///< 0 (not found) to 1
};

}  // namespace bodice::body
