// Places of the body between its ends.
#pragma once

#include <bodice/body/landmark.hpp>

#include "coordinates/body_coordinates.hpp"

namespace bodice::anatomy {

/// A loop around a limb or the neck.
struct Girth {
  geometry::Vec3 center = geometry::Vec3::Zero();
  geometry::Index vertex = geometry::kNoIndex;  ///< of the skin, near the loop
  double girth_m = 0.0;
  double confidence = 0.0;
  float level_m = 0.0F;                       ///< mean distance of the loop from the end of its limb
  float from_front = 0.0F, from_back = 0.0F;  ///< least distance on the loop from breastbone and back, meters
};

struct Landmarks {
  geometry::Index crown = geometry::kNoIndex;
  geometry::Vec3 crown_place = geometry::Vec3::Zero();
  double crown_confidence = 1.0;
  Girth neck;
  geometry::Vec3 neck_place = geometry::Vec3::Zero();
  std::array<Girth, 2> elbow, knee;
  std::array<geometry::Vec3, 2> elbow_place{}, knee_place{};
  std::array<geometry::Index, 2> armpit{};
  std::array<geometry::Vec3, 2> armpit_place{};
  std::array<double, 2> armpit_confidence{};
  std::array<double, 2> fingertip_confidence{1.0, 1.0}, toe_confidence{1.0, 1.0};
  geometry::Index perineum = geometry::kNoIndex;
  geometry::Vec3 perineum_place = geometry::Vec3::Zero();
  double perineum_confidence = 0.0;
};

Landmarks find_landmarks(const engine::Context& context, const Skin& skin,
                         const BodyCoordinates& coordinates);

/// In the order of LandmarkId.
std::vector<body::Landmark> as_list(const Skin& skin, const BodyExtremities& ends, const Landmarks& marks);

}  // namespace bodice::anatomy
