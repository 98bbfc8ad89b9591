// The tolerances of the layer, each with its unit and reason.
#pragma once

namespace bodice::inline v0_1::rig {

/// Least determinant of a map over the product of its columns' lengths, no unit: a map closer to singular has
/// an inverse that keeps less than half of the digits.
inline constexpr double kSingular = 1e-8;

/// Allowed distance of the sum of a vertex's weights from 1, no unit: files keep weights in 8 bits at the
/// worst, and four of them rounded err by 4 / 510.
inline constexpr double kWeightSum = 8e-3;

/// Allowed distance of a key's rotation from a unit quaternion, no unit: files keep 16 bits at the worst, and
/// some exporters write sums of float products.
inline constexpr double kUnitRotation = 1e-2;

/// Allowed shear of a map that is written as translation, rotation and scale: cosine between its columns, no
/// unit. Chains of float matrices 20 deep drift by less.
inline constexpr double kShear = 1e-5;

}  // namespace bodice::rig
