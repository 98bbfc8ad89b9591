// The back of the neck's base: the prominent vertebra (C7).
#include <coefficients/neck_back.hpp>

#include "landmarks/base/skin_signature.hpp"

namespace bodice::inline v0_1::anatomy {
namespace of_neck_back {
namespace {

constexpr SkinSignature kSignature = make_signature<kCoordinateCount, kBuildCount>(
    coefficients::neck_back::kMean, coefficients::neck_back::kOfBody, coefficients::neck_back::kWhiten);

FoundLandmark find(const LandmarkInput& input, int side) {
  return find_by_signature(input, LandmarkId::kNeckBack, side, kSignature);
}

}  // namespace
}  // namespace of_neck_back

LandmarkKind neck_back() {
  return {.id = LandmarkId::kNeckBack,
          .paired = false,
          .part = body::Part::kTorsoUL,
          .find = of_neck_back::find,
          .on_skin = true,
          .recipe = Recipe::kSignature};
}

}  // namespace bodice::anatomy
