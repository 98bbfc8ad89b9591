// The tolerances of the layer, each with its unit and reason. Lengths are those of a body of 1.70 m.
#pragma once

namespace bodice::inline v0_1::binding {

inline constexpr double kReferenceStature_m = 1.70;

/// Skin within this of the ellipsoid nearest to it counts for an ellipsoid's affine map, falling to zero,
/// meters: wide enough that neighbors agree where they blend.
inline constexpr double kOwnedBand_m = 0.020;

/// Weight of the blend of its joints in an ellipsoid's affine map, of the weight of its skin, no unit. With
/// less, flat pieces of skin would leave directions undetermined; with more, bent limbs are followed less.
inline constexpr double kBlendRidge = 0.05;

/// A texel follows the skin if the skin is within this of the table's surface there, meters: several times
/// the error of a table.
inline constexpr double kNearSkin_m = 0.004;
/// A texel follows the skin only if its ellipsoid is at most this farther from the skin point than the
/// nearest ellipsoid is, meters. A pose changes owners by less.
inline constexpr double kNearOwner_m = 0.012;

/// Mean departure of the skin from an ellipsoid's map, in poses with every joint turned, from which its table
/// follows the skin, meters: below it the table's own error is larger.
inline constexpr double kStiff_m = 0.0003;

/// Joints that move an ellipsoid's skin apart by less than this move it as one, meters: a table's bytes do
/// not show it.
inline constexpr double kAlike_m = 2e-5;

/// A joint that moves a smaller share of an ellipsoid's center does not count in the choice of base poses, no
/// unit.
inline constexpr double kLeastTurning = 0.02;
/// Two poses count as equal if their joints differ by less than this, because their tables differ by less
/// than a step of a byte.
inline constexpr double kSameTurn_rad = 0.03;
/// A smaller share of a base pose changes a table by hundredths of a millimeter, no unit.
inline constexpr float kLeastShare = 0.01f;

/// Least posed radius over the least radius at rest, no unit: a table on a flat disk has no directions.
inline constexpr double kFlattest = 0.05;
/// An affine map that shrinks volumes to less than kFoldedVolume may fold. It keeps at least kLeastLength of
/// each length, so that heights over its ellipsoid stay within the reach of relief. No unit. With .4 the
/// proxy of one body with raised arms misses up to 24 mm of its skin, with .5 22, and without a limit 47.
inline constexpr double kFoldedVolume = 0.6, kLeastLength = 0.5;
/// Largest depth and height of a posed table over the reach of relief, no unit: more would only come from
/// skin that has left the ellipsoid, and cost the others their digits. Skin that the body covers in its rest
/// pose needs the depth.
inline constexpr double kDeepest = 1.0, kHighest = 0.8;
/// A table yields to others where its skin sank or rose by more than these in a pose, in reaches of relief:
/// there the skin folds, or another ellipsoid has come between. Less is what the joints of a walk do.
inline constexpr double kMostSinking = 1.0 / 15.0, kMostRising = 0.4;
/// The most that yielding adds to the score of a table, in reaches of relief. Where all tables are that far
/// off, the nearest one serves.
inline constexpr double kMostYield = 1.0 / 3.0;
/// Least slope of the corrected distance along the normal that heights are divided by, no unit.
inline constexpr double kLeastSlope = 0.2;

}  // namespace bodice::binding
