// An ellipsoid moved by a matrix of the host.
#pragma once

#include <string_view>

#include <bodice/geometry/ellipsoid.hpp>
#include <bodice/proxy/binding.hpp>

namespace bodice::inline v0_1::capi {

/// Moves an ellipsoid by a matrix that is a rotation times a scale up to rounding, which is mended. Returns
/// why the matrix is refused, or nothing. Allocates nothing.
std::string_view move_ellipsoid(const geometry::Ellipsoid& rest, const proxy::JointMatrix& map,
                                geometry::Ellipsoid& out);

}  // namespace bodice::capi
