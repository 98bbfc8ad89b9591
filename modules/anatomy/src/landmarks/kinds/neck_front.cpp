// The front of the neck's base: the notch above the breastbone.
#include <coefficients/neck_front.hpp>

#include "landmarks/base/skin_signature.hpp"

namespace bodice::inline v0_1::anatomy {
namespace of_neck_front {
namespace {

constexpr SkinSignature kSignature = make_signature<kCoordinateCount, kBuildCount>(
    coefficients::neck_front::kMean, coefficients::neck_front::kOfBody, coefficients::neck_front::kWhiten);

FoundLandmark find(const LandmarkInput& input, int side) {
  return find_by_signature(input, LandmarkId::kNeckFront, side, kSignature);
}

}  // namespace
}  // namespace of_neck_front

LandmarkKind neck_front() {
  return {.id = LandmarkId::kNeckFront,
          .paired = false,
          .part = body::Part::kTorsoUL,
          .find = of_neck_front::find,
          .on_skin = true,
          .recipe = Recipe::kSignature};
}

}  // namespace bodice::anatomy
