// The two fallbacks that cannot fail: leaving the union along a ray, and stopping where the particle's path
// entered it. Both use that the signed distance to a convex body is convex along a line, so that its tangent
// never lies above it.
#pragma once

#include <optional>

#include "exact/near_field.hpp"
#include "exact/response.hpp"
#include "exact/union_field.hpp"

namespace bodice::inline v0_1::collision {

/// Ray exit: the first point along p + t direction, t >= 0, that is at least `clearance_m` from every
/// ellipsoid, or just behind it. `direction` is a unit vector. Each ellipsoid is left by a few Newton steps.
/// A line leaves a convex body for good, so at most size() ellipsoids are left and the walk ends. Nothing if
/// the point is farther than `longest_m`, or if rounding stops the walk.
std::optional<geometry::Vec3> exit_along_ray(const UnionField& field, const geometry::Vec3& p,
                                             const geometry::Vec3& direction, double clearance_m,
                                             double longest_m);

/// The point where the segment from `safe` to `p` first comes within `clearance_m` of an ellipsoid.
struct Entry {
  geometry::Vec3 point;   ///< at least clearance_m from every ellipsoid
  geometry::Vec3 normal;  ///< normal of the ellipsoid that is reached there
  std::uint32_t ellipsoid = kNoEllipsoid;
};

/// First entry of the segment into the union; nothing if the segment stays clear, or if `safe` itself is not
/// clear.
std::optional<Entry> first_entry(const UnionField& field, const geometry::Vec3& safe, const geometry::Vec3& p,
                                 double clearance_m);

/// First entry into a nonconvex surface (relief, fillets) that bulges out of the plain ellipsoids by up to
/// `bulge_m`. Steps are half the distance, at least kPathStep. Features thinner than a step along the path
/// are missed; the point found is clear.
std::optional<Entry> first_nonconvex_entry(NearField& near, const UnionField& field, double bulge_m,
                                           const geometry::Vec3& safe, const geometry::Vec3& p,
                                           double clearance_m);

/// The ellipsoid that the path from the particle's safe position to `end` passes through, or kNoEllipsoid.
/// The path counts as passing through if it leaves where the surface has turned by more than 60 degrees; less
/// is a particle that slides over a curved surface. The path is taken relative to the moving ellipsoid.
std::uint32_t passed_through(const UnionField& field, const ParticleState& particle,
                             const geometry::Vec3& end);

}  // namespace bodice::collision
