// The perineum: the point between the legs where the floor of the trunk begins to rise to the front.
#include <algorithm>
#include <cmath>

#include "landmarks/base/landmark_kind.hpp"
#include "landmarks/kinds/perineum_by_legs.hpp"
#include "landmarks/kinds/perineum_by_shape.hpp"

namespace bodice::inline v0_1::anatomy {
namespace of_perineum {
namespace {

/// The Mahalanobis distance from which a signature is no evidence, in deviations. One correct perineum in
/// fifty has more than 4.
constexpr double kNoEvidence = 6.4;
/// The difference between the perineum's margin and kFoldMargin, in deviations, from which the choice between
/// perineum and fold behind it is clear.
constexpr double kClearlyNoFold = 1.0;
/// The correction by the legs at which a perineum is no evidence any more, as a fraction of the body size.
/// Among 3,356 bodies 8 had one of more than .04, and the largest of those that were still 4 % of the stature
/// off was .066.
constexpr double kNoEvidenceShift = 0.06;
/// One perineum in a hundred that is right lies farther from its second estimate, as a fraction of the body
/// size.
constexpr double kMaxDifference = 0.085;

/// Takes the perineum from the body coordinates, which need it themselves and find it by its signature.
FoundLandmark find(const LandmarkInput& input, int) {
  const BodyCoordinates& coordinates = input.coordinates;
  const double no_fold = std::abs(static_cast<double>(coordinates.perineum_margin() - kFoldMargin));
  const double confidence =
      confidence_of(static_cast<double>(coordinates.perineum_mahalanobis()), kNoEvidence) *
      std::min(1.0, no_fold / kClearlyNoFold);
  return {{LandmarkId::kPerineum, coordinates.perineum_position(), coordinates.perineum(), confidence}, {}};
}

FoundLandmark refine(const LandmarkInput& input, const Landmarks& marks, int) {
  FoundLandmark perineum = marks[LandmarkId::kPerineum];
  perineum.mark.position = perineum_by_shape(input, marks);
  return perineum;
}

FoundLandmark finish(const LandmarkInput& input, const Landmarks& marks, int) {
  FoundLandmark perineum = marks[LandmarkId::kPerineum];
  const Corrected moved = perineum_by_legs(input, marks);
  perineum.mark.position = moved.position;
  perineum.mark.confidence *= confidence_of(moved.wanted, kNoEvidenceShift);
  return perineum;
}

/// The distance of the perineum from the point where the discs around both feet first touch.
double difference(const LandmarkInput& input, const Landmarks&, int) {
  const SkinPoint& merge = input.coordinates.leg_merge().at;
  if (!merge.found()) return -1.0;
  return static_cast<double>(value_at(input.skin, merge, input.coordinates.from_perineum()) /
                             input.coordinates.size_m());
}

}  // namespace
}  // namespace of_perineum

LandmarkKind perineum() {
  return {.id = LandmarkId::kPerineum,
          .part = body::Part::kThighL,
          .find = of_perineum::find,
          .refine = of_perineum::refine,
          .finish = of_perineum::finish,
          .checks = {{{of_perineum::difference, of_perineum::kMaxDifference,
                       "The perineum and the point where the legs join along the skin lie far from each "
                       "other."}}},
          .warn_uncertain = true,
          .doubt = 1,
          .on_skin = true,
          .recipe = Recipe::kCorrections};
}

}  // namespace bodice::anatomy
