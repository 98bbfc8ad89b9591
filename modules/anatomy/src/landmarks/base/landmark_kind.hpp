// The entry of one kind of landmark in the table of landmarks.
#pragma once

#include <bodice/body/part.hpp>

#include "landmarks/base/landmarks.hpp"

namespace bodice::inline v0_1::anatomy {

/// A second estimate of a landmark that shares no coefficients with the first.
struct CrossCheck {
  /// The distance of the two estimates as a fraction of the body size; negative where there is no second one.
  double (*difference)(const LandmarkInput& input, const Landmarks& marks, int side) = nullptr;
  double most = 0.0;  ///< a difference above it is a contradiction; half the confidence is left at it
  const char* warning = nullptr;  ///< what a contradiction means to a user; null: only the confidence falls
};

/// How the program bench/calibrate makes the coefficients of a landmark.
enum class Recipe {
  kNone,         ///< it does not
  kSignature,    ///< landmarks/base/skin_signature.hpp
  kTrunkLevel,   ///< landmarks/base/level_loop.hpp, find_trunk_level()
  kLimbLevel,    ///< landmarks/base/level_loop.hpp, find_limb_level()
  kCorrections,  ///< landmarks/base/correction.hpp
};

/// How one kind of landmark is found. A step that is null is left out. The steps of all kinds run in this
/// order: `find` of all kinds side by side, `refine` kind by kind in the order of the table, `finish`
/// likewise, `checks` side by side. A step that takes `marks` computes both sides before either changes.
struct LandmarkKind {
  LandmarkId id = LandmarkId::kCrown;  ///< the left one of a pair
  bool paired = false;
  body::Part part = body::Part::kHead;  ///< named by warnings about it; the left one of a pair
  /// The first estimate, from the body's coordinates alone.
  FoundLandmark (*find)(const LandmarkInput& input, int side) = nullptr;
  /// A better estimate from this and other landmarks.
  FoundLandmark (*refine)(const LandmarkInput& input, const Landmarks& marks, int side) = nullptr;
  /// The last estimate, when every landmark is refined.
  FoundLandmark (*finish)(const LandmarkInput& input, const Landmarks& marks, int side) = nullptr;
  std::array<CrossCheck, 2> checks{};
  bool warn_uncertain = false;  ///< a confidence below kUncertain gives a warning
  int doubt = 0;                ///< how much doubt about it counts as a sign of fused limbs
  bool on_skin = false;         ///< its vertex is the one nearest to where it ends up
  Recipe recipe = Recipe::kNone;
};

/// The confidence below which a landmark is named in a warning.
inline constexpr double kUncertain = 0.35;

/// A confidence by a Mahalanobis distance: 1 at a distance of 0, and 0 from `no_evidence_at` on.
inline double confidence_of(double mahalanobis, double no_evidence_at) {
  const double m = mahalanobis / no_evidence_at;
  return std::max(0.0, 1.0 - m * m);
}

}  // namespace bodice::anatomy
