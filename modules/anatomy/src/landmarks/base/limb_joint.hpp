// Elbow and knee: the joints in the middle of a limb.
#pragma once

#include <span>

#include "landmarks/base/landmark_kind.hpp"

namespace bodice::anatomy {

/// Moves a joint from the center of its loop along the limb's two bones by what the body's lengths say.
/// `root`: where the limb leaves the trunk; `end`: its tip. Skin weights put the border below the joint, the
/// more so on heavy bodies. `weights`: along the upper and the lower bone. O(1).
geometry::Vec3 limb_joint(const LandmarkInput& input, const Loop& loop, const geometry::Vec3& root,
                          const geometry::Vec3& end, std::array<std::span<const double>, 2> weights);

/// A limb as its cross-check reads it. Shares are of the length from its tip to where it leaves the trunk.
struct Limb {
  const geodesic::Field& from_end;  ///< distances from its tip
  float length_m;                   ///< from its tip to where it leaves the trunk, along the skin
  float from, to;                   ///< shares between which the joint may lie
  float share;                      ///< where the joint lies on a straight limb
};

/// Distance along the limb, as a fraction of the body size, between its joint's loop and where the limb bends
/// or, on a straight limb, where joints usually lie; -1 without a loop. O(#F).
double joint_difference(const LandmarkInput& input, const Limb& limb, const Loop& loop);

}  // namespace bodice::anatomy
