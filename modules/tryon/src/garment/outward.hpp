// The direction away from the skin.
#pragma once

#include <cmath>

#include <bodice/geometry/mesh_distance.hpp>

namespace bodice::inline v0_1::tryon {

/// The direction from the closest point of the skin to a point outside, or the opposite one to a point
/// inside.
inline geometry::Vec3 outward(const geometry::MeshDistance& skin, const geometry::Vec3& p) {
  const geometry::SurfacePoint below = skin.closest_point(p);
  return std::abs(below.signed_distance) > 1e-9 ? geometry::Vec3((p - below.point) / below.signed_distance)
                                                : below.normal;
}

}  // namespace bodice::tryon
