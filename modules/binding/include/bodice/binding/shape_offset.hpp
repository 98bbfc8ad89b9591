// How far the ellipsoids of one shape of a body are off those of another, so that a surface can go over from
// one to the other.
#pragma once

#include <bodice/geometry/ellipsoid.hpp>
#include <bodice/geometry/types.hpp>

namespace bodice::inline v0_1::binding {

/// The map of an ellipsoid at rest to the same one of another shape, in its own units: a point that lies at
/// center + M u lies at center + M (u + map u + shift) there, with M = axes diag(radii).
struct ShapeOffset {
  geometry::Vec3 shift = geometry::Vec3::Zero();
  geometry::Mat3 map = geometry::Mat3::Zero();
};

/// The offset of `other`. Its axes must be in the order of those of `own`.
ShapeOffset offset_of(const geometry::Ellipsoid& own, const geometry::Ellipsoid& other);

/// Displaces a posed ellipsoid by a share of its offset: its center, its radii, and its axes by a turn. What
/// the offset shears is left out, so that directions of the ellipsoid stay those of its table. `material` is
/// that of proxy::PosedProxy. Exact to first order; a share of zero changes no bit.
void displace(const ShapeOffset& offset, double share, geometry::Ellipsoid& shape, geometry::Mat3& material);

}  // namespace bodice::binding
