// The outline of the head from the forehead over the crown to the back.
#pragma once

#include "landmarks/base/landmarks.hpp"

namespace bodice::inline v0_1::anatomy {

/// The deepest hollow of the outline in the plane of symmetry, a fraction of the body size: how far the skin
/// lies below a band that is stretched over it. A bare head bulges everywhere; hair that is tied up leaves a
/// hollow before it. `up` leads from the neck to the middle of the head, `forward` is normal to it; both are
/// unit. O(#F).
double hollow_of_head(const LandmarkInput& input, const geometry::Vec3& up, const geometry::Vec3& forward);

}  // namespace bodice::anatomy
