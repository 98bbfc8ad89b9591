// The side of the neck's base, where it turns into the shoulder.
#include <coefficients/neck_side.hpp>

#include "landmarks/base/skin_signature.hpp"

namespace bodice::inline v0_1::anatomy {
namespace of_neck_side {
namespace {

constexpr SkinSignature kSignature = make_signature<kCoordinateCount, kBuildCount>(
    coefficients::neck_side::kMean, coefficients::neck_side::kOfBody, coefficients::neck_side::kWhiten);

FoundLandmark find(const LandmarkInput& input, int side) {
  return find_by_signature(input, LandmarkId::kNeckSideL, side, kSignature);
}

}  // namespace
}  // namespace of_neck_side

LandmarkKind neck_side() {
  return {.id = LandmarkId::kNeckSideL,
          .paired = true,
          .part = body::Part::kTorsoUL,
          .find = of_neck_side::find,
          .on_skin = true,
          .recipe = Recipe::kSignature};
}

}  // namespace bodice::anatomy
