// What the closest-point response does with velocities and with positions that are stored in float.
#pragma once

#include "exact/halfspaces.hpp"

namespace bodice::inline v0_1::collision {

/// Removes the inward part of the velocity and slows the rest by Coulomb friction; restitution is 0.
inline void correct_velocity(const Halfspaces& contact, double friction, geometry::Vec3& velocity) {
  const geometry::Vec3 along = contact.closest_velocity(velocity);
  const double impulse = (along - velocity).norm();
  const double speed = along.norm();
  velocity = speed > friction * impulse ? geometry::Vec3(along * (1.0 - friction * impulse / speed))
                                        : geometry::Vec3(geometry::Vec3::Zero());
}

/// The position as it will be stored, in float. It goes through memory, because g++ 12 optimizes a vectorized
/// pair of casts to float and back away.
inline geometry::Vec3 rounded_to_float(const geometry::Vec3& x) {
  const auto rounded = [](double v) {
    const volatile float narrow = static_cast<float>(v);
    return double{narrow};
  };
  return {rounded(x.x()), rounded(x.y()), rounded(x.z())};
}

inline Halfspaces single(const geometry::Vec3& normal) {
  Halfspaces result;
  result.add({normal, 0.0});
  return result;
}

}  // namespace bodice::collision
