#pragma once

#include <bodice/fitting/fit.hpp>

namespace bodice::inline v0_1::fitting {

/// Maps a body to one of 1.7 m at the origin. Optimizations run on that one, so that their tolerances are
/// lengths and floats suffice.
struct Scaling {
  geometry::Vec3 origin = geometry::Vec3::Zero();
  double scale = 1.0;

  explicit Scaling(const LabeledSkin& skin)
      : origin(geometry::bounding_box(skin.mesh.positions).center()), scale(1.7 / skin.stature_m) {}

  double mm() const { return 1e-3 / scale; }  ///< a millimeter of the scaled body, in meters of the real one
  geometry::Ellipsoid in(const geometry::Ellipsoid& e) const {
    return {(e.center - origin) * scale, e.axes, e.radii * scale};
  }
  geometry::Ellipsoid out(const geometry::Ellipsoid& e) const {
    return {e.center / scale + origin, e.axes, e.radii / scale};
  }
};

}  // namespace bodice::fitting
