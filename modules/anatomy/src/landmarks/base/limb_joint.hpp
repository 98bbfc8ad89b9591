// Elbow and knee: the joints in the middle of a limb.
#pragma once

#include <span>

#include "landmarks/base/landmark_kind.hpp"

namespace bodice::inline v0_1::anatomy {

/// The two bones of a limb, and the coefficients of the correction along each.
struct LimbBones {
  geometry::Vec3 root;  ///< where the limb leaves the trunk
  geometry::Vec3 end;   ///< its tip
  std::span<const double> upper, lower;
};

/// Moves a joint from the center of its loop along the limb's two bones by what the body's lengths say. Skin
/// weights put the border below the joint, the more so on heavy bodies. O(1).
geometry::Vec3 limb_joint(const LandmarkInput& input, LandmarkId of, const Loop& loop,
                          const LimbBones& bones);

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
