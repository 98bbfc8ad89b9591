// The sole of a foot: the plane that it stands on, however the ankle is bent.
#pragma once

#include <optional>
#include <span>

#include "joints/frames.hpp"

namespace bodice::inline v0_1::rigging {

struct Sole {
  Mat3 frame = Mat3::Identity();   ///< y off the floor, z to the toes
  double height = 0.0;             ///< of the sole along y
  double rear = 0.0, front = 0.0;  ///< ends of the foot along z
};

/// `across` points to the body's left, `shin` from knee to ankle. The sole is the longest edge of the foot's
/// convex outline in the plane across which the ankle bends, among those that look away from the shin.
/// Nothing where the points have no such edge. O(n log n).
std::optional<Sole> find_sole(std::span<const Vec3> foot, const Vec3& across, const Vec3& shin);

}  // namespace bodice::rigging
