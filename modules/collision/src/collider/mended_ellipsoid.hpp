// Ellipsoids of a host: mended, or refused with a reason.
#pragma once

#include <string_view>

#include <bodice/geometry/ellipsoid.hpp>

namespace bodice::inline v0_1::collision {

/// Mends the axes of an ellipsoid that are off by up to a thousandth, and moves their scale to the radii.
/// Returns why it is refused, a predicate such as "mirrors"; empty: it is fit. Allocates nothing.
std::string_view mend(geometry::Ellipsoid& e) noexcept;

}  // namespace bodice::collision
