#include "landmarks/base/limb_joint.hpp"

#include <algorithm>
#include <cmath>

#include "coordinates/body_lengths.hpp"
#include "landmarks/base/correction.hpp"
#include "skin/centerline.hpp"

namespace bodice::inline v0_1::anatomy {
namespace {

using geometry::Vec3;

/// The bend below which a limb shows no joint, so that the joint is estimated by proportion. A bend alone
/// contradicts nothing: on heavy arms it may be flesh at the wrist or a raised shoulder.
constexpr float kBent_rad = 0.6F;

}  // namespace

Vec3 limb_joint(const LandmarkInput& input, LandmarkId of, const Loop& loop, const LimbBones& bones) {
  if (!loop.found()) return loop.center;
  const BodyLengths lengths = body_lengths(input.coordinates);
  const std::vector<double> measures(lengths.begin(), lengths.end());
  const Vec3 upper = (loop.center - bones.root).normalized(), lower = (bones.end - loop.center).normalized();
  return corrected(input,
                   {of,
                    loop.center,
                    {{upper, measures, {"upper", bones.upper}}, {lower, measures, {"lower", bones.lower}}},
                    kMostByLengths})
      .position;
}

double joint_difference(const LandmarkInput& input, const Limb& limb, const Loop& loop) {
  if (!loop.found() || !(limb.length_m > 0.0F)) return -1.0;
  const Bend bend =
      sharpest_bend(input.skin, limb.from_end, limb.from * limb.length_m, limb.to * limb.length_m);
  float apart = std::abs(limb.share * limb.length_m - loop.level_m);
  if (bend.angle_rad > kBent_rad) apart = std::min(apart, std::abs(bend.level - loop.level_m));
  return static_cast<double>(apart / input.coordinates.size_m());
}

}  // namespace bodice::anatomy
