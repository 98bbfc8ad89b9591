// The two ways out that cannot fail, for what iteration does not resolve. Both use that the signed distance
// to a convex body is convex along a line: a tangent never lies above it.
#pragma once

#include <optional>

#include "exact/near_field.hpp"
#include "exact/response.hpp"
#include "exact/union_field.hpp"

namespace bodice::collision {

/// The first place along p + t direction, t >= 0, that is at least `clearance_m` from every ellipsoid, or
/// just behind it: each body is left by a few of Newton's steps. `direction` is a unit vector. A line leaves
/// a convex body for good, so at most size() bodies are left and the walk ends; nothing if the place is
/// farther than `longest_m`, or if rounding makes it stand still.
std::optional<geometry::Vec3> exit_along_ray(const UnionField& field, const geometry::Vec3& p,
                                             const geometry::Vec3& direction, double clearance_m,
                                             double longest_m);

/// Where the segment from `safe` to `p` first comes within `clearance_m` of an ellipsoid.
struct Entry {
  geometry::Vec3 point;   ///< at least clearance_m from every ellipsoid
  geometry::Vec3 normal;  ///< of the ellipsoid that is met there
  std::uint32_t ellipsoid = kNoEllipsoid;
};

/// Nothing if the segment stays clear, or if `safe` itself is not.
std::optional<Entry> first_entry(const UnionField& field, const geometry::Vec3& safe, const geometry::Vec3& p,
                                 double clearance_m);

/// The same for a surface that bulges out of the plain ellipsoids by up to `bulge_m` and is not convex
/// (relief, fillets): steps of half the distance, and of kPathStep where that is less. What is thinner along
/// the path is stepped over; the place found is clear.
std::optional<Entry> first_nonconvex_entry(NearField& near, const UnionField& field, double bulge_m,
                                           const geometry::Vec3& safe, const geometry::Vec3& p,
                                           double clearance_m);

/// The ellipsoid that the path from the particle's safe position to `end` passed through, as that ellipsoid
/// sees it, and out again at a place where its surface has turned by more than 60 degrees: less is a particle
/// that slides over a curved surface. kNoEllipsoid if there is none.
std::uint32_t passed_through(const UnionField& field, const ParticleState& particle,
                             const geometry::Vec3& end);

}  // namespace bodice::collision
