#include "scan/hair.hpp"

#include <algorithm>
#include <cmath>

#include "scan/landmark_of.hpp"

namespace bodice::inline v0_1::synth {
namespace {

using geometry::Box;
using geometry::DistanceField;
using geometry::Vec3;

/// An upright cylinder with an elliptical cross-section, between two levels.
struct Curtain {
  Vec3 middle;  ///< a point on the axis
  double half_width_m, half_depth_m, low_m, high_m;

  double distance(const Vec3& p) const {
    const double from_axis =
        std::hypot((p.x() - middle.x()) / half_width_m, (p.z() - middle.z()) / half_depth_m);
    return std::max({(from_axis - 1.0) * half_depth_m, low_m - p.y(), p.y() - high_m});
  }
};

}  // namespace

Solid hair_in_a_bun(const Body& body, engine::Random& random) {
  const double back = random.uniform(0.0, 1.0), radius_m = random.uniform(0.04, 0.06);
  const Vec3 middle =
      landmark_of(body, body::LandmarkId::kCrown) - Vec3(0.0, 0.13 * back * back - 0.03, 0.02 + 0.09 * back);
  const Vec3 radii = Vec3::Constant(radius_m);
  return {[middle, radius_m](const Vec3& p) { return (p - middle).norm() - radius_m; },
          {middle - radii, middle + radii}};
}

Solid hair_that_hangs(const Body& body, const DistanceField& skin, engine::Random& random) {
  const Vec3 crown = landmark_of(body, body::LandmarkId::kCrown),
             neck = landmark_of(body, body::LandmarkId::kNeck);
  const double ears_m = 0.5 * (crown.y() + neck.y());
  const double cap_m = random.uniform(0.005, 0.015);
  const double behind_m = random.uniform(0.05, 0.08), below_m = random.uniform(0.1, 0.45);
  const Curtain curtain{neck - behind_m * Vec3::UnitZ(), random.uniform(0.08, 0.12),
                        random.uniform(0.035, 0.06), neck.y() - below_m, ears_m};
  const auto cap = [skin, cap_m, ears_m, neck](const Vec3& p) {
    return std::max({skin(p) - cap_m, ears_m - p.y(), p.z() - neck.z() - 0.02});
  };
  const Vec3 reach(curtain.half_width_m, 0.0, curtain.half_depth_m);
  Box box{curtain.middle - reach, curtain.middle + reach};
  box.low.y() = curtain.low_m;
  box.high.y() = crown.y() + cap_m;
  return {[cap, curtain](const Vec3& p) { return std::min(cap(p), curtain.distance(p)); }, box};
}

}  // namespace bodice::synth
