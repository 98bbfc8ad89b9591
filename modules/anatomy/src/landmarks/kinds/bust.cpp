// The bust point: the middle of a breast at the level of the chest line.
#include <coefficients/bust.hpp>

#include "landmarks/base/skin_signature.hpp"

namespace bodice::inline v0_1::anatomy {
namespace of_bust {
namespace {

constexpr SkinSignature kSignature = make_signature<kCoordinateCount, kBuildCount>(
    coefficients::bust::kMean, coefficients::bust::kOfBody, coefficients::bust::kWhiten);

FoundLandmark find(const LandmarkInput& input, int side) {
  return find_by_signature(input, LandmarkId::kBustL, side, kSignature);
}

}  // namespace
}  // namespace of_bust

LandmarkKind bust() {
  return {.id = LandmarkId::kBustL,
          .paired = true,
          .part = body::Part::kTorsoUL,
          .find = of_bust::find,
          .on_skin = true,
          .recipe = Recipe::kSignature};
}

}  // namespace bodice::anatomy
