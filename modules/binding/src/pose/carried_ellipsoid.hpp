// One ellipsoid carried to a pose.
#pragma once

#include <span>

#include <bodice/geometry/ellipsoid.hpp>
#include <bodice/proxy/binding.hpp>

namespace bodice::inline v0_1::binding {

/// An ellipsoid in the pose: the image of the one at rest under its affine map.
struct CarriedEllipsoid {
  geometry::Ellipsoid shape;
  geometry::Mat3 to_table = geometry::Mat3::Identity();  ///< V: a unit direction of the pose to one at rest
  double scale = 1.0;                                    ///< of its volume, to the third root
};

/// A = sum_j T_j M_kj of some terms: eq. (1) of bind.hpp.
proxy::JointMatrix affine_map(std::span<const proxy::CarryTerm> terms,
                              std::span<const proxy::JointMatrix> skinning);

/// The map, but not folded: where joints fold the skin over an ellipsoid, its map becomes flat and then
/// mirrors, within a few frames. The skin does neither. The image of `center` stays. `body_scale` is the
/// body's size divided by its size at rest.
proxy::JointMatrix unfolded(const proxy::JointMatrix& map, const geometry::Vec3& center, double body_scale);

/// The image: A R diag(r) = U S V^T gives axes U and radii S.
CarriedEllipsoid carry(const geometry::Ellipsoid& rest, const proxy::JointMatrix& map);

/// The image without its shear; its table is read as at rest: V is the identity.
CarriedEllipsoid carry_stiffly(const geometry::Ellipsoid& rest, const proxy::JointMatrix& map);

}  // namespace bodice::binding
