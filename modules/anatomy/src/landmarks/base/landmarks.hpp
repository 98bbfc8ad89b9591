// What is known of the landmarks while they are being found.
#pragma once

#include <bodice/body/landmark.hpp>

#include "landmarks/base/head_profile.hpp"

namespace bodice::inline v0_1::anatomy {

using body::LandmarkId;

/// One landmark of one side as a step of its search gives it; landmarks in joints and levels have a loop.
struct FoundLandmark {
  body::Landmark mark;
  Loop loop;
};

/// All landmarks as far as they are known, by LandmarkId.
struct Landmarks {
  std::array<FoundLandmark, body::kLandmarkCount> of;
  std::optional<HeadProfile> head_profile;  ///< empty before the first estimates, and without head or neck

  FoundLandmark& operator[](LandmarkId id) { return of[static_cast<std::size_t>(id)]; }
  const FoundLandmark& operator[](LandmarkId id) const { return of[static_cast<std::size_t>(id)]; }
  const geometry::Vec3& at(LandmarkId id) const { return (*this)[id].mark.position; }
  /// The landmark `left` or its right counterpart; side 0: left, 1: right.
  const geometry::Vec3& at(LandmarkId left, int side) const { return at(body::of_side(left, side)); }
};

struct CorrectionRecords;

/// What landmarks are found from. It is complete before the search begins and does not change.
struct LandmarkInput {
  const engine::Context& context;
  const Skin& skin;
  const BodyCoordinates& coordinates;
  Ball head;                             ///< the ball that the skin above the neck's border resembles
  CorrectionRecords* records = nullptr;  ///< takes what corrections are computed from; null: nothing does

  double size_m() const { return static_cast<double>(coordinates.size_m()); }
  const BodyExtremities& tips() const { return coordinates.extremities(); }
  /// Whether limbs are welded to each other, so that landmarks near the welds may be wrong.
  bool fused() const { return skin.handles > 0; }
};

}  // namespace bodice::anatomy
