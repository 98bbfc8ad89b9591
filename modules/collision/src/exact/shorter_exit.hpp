// Shortens the exit of a particle from a union of plain ellipsoids.
#pragma once

#include <optional>

#include "exact/union_field.hpp"

namespace bodice::inline v0_1::collision {

/// A clear point that is as near to `p` as descent finds, starting from the clear point `exit`; nothing
/// unless it is nearer than kWorthShortening of that. A point is clear if no ellipsoid is nearer than
/// `clearance_m`. Takes at most 12 rounds of one closest point for each ellipsoid within reach; of more
/// ellipsoids than its list holds nothing is found.
std::optional<geometry::Vec3> shorter_exit(const UnionField& field, const geometry::Vec3& p,
                                           const geometry::Vec3& exit, double clearance_m);

}  // namespace bodice::collision
