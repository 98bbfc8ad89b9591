// Measurements of a body for garments.
#pragma once

#include <bodice/anatomy/anatomy.hpp>
#include <bodice/body/measurement.hpp>

namespace bodice::inline v0_1::anatomy {

/// Takes the 26 measurements of an analyzed body, in meters (the mesh's unit) and radians; NaN where a
/// landmark or a girth that one needs was not found. They are meant for a body that stands, with arms away
/// from the trunk; in other poses flesh and spine bend, and girths and lengths change with them. `skin`: the
/// mesh that was analyzed. modules/anatomy/MEASUREMENTS.md defines each measurement and states its error on
/// made bodies. O(#F).
body::Measurements measure(const geometry::TriMesh& skin, const Anatomy& anatomy);

}  // namespace bodice::anatomy
