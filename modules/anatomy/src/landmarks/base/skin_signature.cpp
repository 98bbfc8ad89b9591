#include "landmarks/base/skin_signature.hpp"

#include <cmath>

#include "landmarks/base/unchecked.hpp"
#include "skin/nearest_signature.hpp"
#include "skin/soft_position.hpp"

namespace bodice::inline v0_1::anatomy {
namespace {

/// A signature this many deviations off is no evidence any more.
constexpr double kNoEvidence = 10.0;

}  // namespace

FoundLandmark find_by_signature(const LandmarkInput& input, LandmarkId left, int side,
                                const SkinSignature& signature) {
  const BodyCoordinates& coordinates = input.coordinates;
  const auto expected = signature.expected(build_of(coordinates));
  const auto of_body = [&](std::size_t v) { return input.skin.component[v] == 0; };
  const auto distance2 = [&](std::size_t v) {
    return signature.distance2(coordinates.at(v, side), expected);
  };
  const std::size_t vertices = input.skin.mesh.positions.size();
  const NearestSignature found = nearest_signature(input.context, vertices, of_body, distance2);
  const float least2 = found.mahalanobis * found.mahalanobis;
  const geometry::Vec3 position =
      soft_position(input.skin, found.vertex, kSoftRadius * input.size_m(),
                    [&](geometry::Index v) { return std::exp(-0.5F * (distance2(v) - least2)); });
  const double confidence = confidence_of(static_cast<double>(found.mahalanobis), kNoEvidence);
  return {{body::of_side(left, side), position, found.vertex, unchecked_confidence(input, confidence)}, {}};
}

}  // namespace bodice::anatomy
