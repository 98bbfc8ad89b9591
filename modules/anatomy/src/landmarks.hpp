// Places of the body between its ends.
#pragma once

#include <bodice/body/landmark.hpp>

#include "sides.hpp"

namespace bodice::anatomy {

/// The ends in the body's own order: index 0 left, 1 right.
struct BodyEnds {
  geometry::Index head = 0;
  std::array<geometry::Index, 2> hand{}, foot{};
  const geodesic::Field* from_head = nullptr;
  std::array<const geodesic::Field*, 2> from_hand{}, from_foot{};
  float hands_apart = 0.0F, feet_apart = 0.0F, head_to_feet = 0.0F;  ///< metres along the skin
};

BodyEnds in_body_order(const EndPoints& ends, const Sides& sides);

/// A girth: where it lies on the distance field of its limb's end, and its middle.
struct Girth {
  float level_m = 0.0F;
  geometry::Vec3 center = geometry::Vec3::Zero();
  double girth_m = 0.0;
  double confidence = 0.0;
};

struct Landmarks {
  Girth neck;
  std::array<Girth, 2> elbow, knee;
  std::array<geometry::Index, 2> armpit{};
  geometry::Index perineum = geometry::kNoIndex;
  double stature_m = 0.0;
};

Landmarks find_landmarks(const Skin& skin, const BodyEnds& ends);

/// In the order of LandmarkId.
std::vector<body::Landmark> as_list(const Skin& skin, const BodyEnds& ends, const Landmarks& marks);

}  // namespace bodice::anatomy
