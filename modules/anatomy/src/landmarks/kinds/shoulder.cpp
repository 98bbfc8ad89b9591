// The tip of the shoulder: the skin over the acromion, above the joint.
#include <coefficients/shoulder.hpp>

#include "landmarks/base/skin_signature.hpp"

namespace bodice::inline v0_1::anatomy {
namespace of_shoulder {
namespace {

constexpr SkinSignature kSignature = make_signature<kCoordinateCount, kBuildCount>(
    coefficients::shoulder::kMean, coefficients::shoulder::kOfBody, coefficients::shoulder::kWhiten);

FoundLandmark find(const LandmarkInput& input, int side) {
  return find_by_signature(input, LandmarkId::kShoulderL, side, kSignature);
}

}  // namespace
}  // namespace of_shoulder

LandmarkKind shoulder() {
  return {.id = LandmarkId::kShoulderL,
          .paired = true,
          .part = body::Part::kUpperArmL,
          .find = of_shoulder::find,
          .on_skin = true,
          .recipe = Recipe::kSignature};
}

}  // namespace bodice::anatomy
