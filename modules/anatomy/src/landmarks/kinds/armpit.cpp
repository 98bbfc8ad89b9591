// The fold behind the arm where it leaves the trunk.
#include <algorithm>
#include <cmath>

#include <coefficients/armpit.hpp>

#include "coordinates/build.hpp"
#include "landmarks/base/correction.hpp"
#include "landmarks/base/landmark_kind.hpp"
#include "landmarks/base/trunk_frame.hpp"
#include "landmarks/kinds/armpit_signature.hpp"

namespace bodice::inline v0_1::anatomy {
namespace of_armpit {
namespace {

using geometry::Vec3;
namespace data = coefficients::armpit;

/// The Mahalanobis distance from which a signature is no evidence, in deviations. One armpit in fifty has
/// more than 5.3, and is mostly correct nevertheless.
constexpr double kNoEvidence = 10.0;
/// The margin over the best vertex elsewhere, in deviations, from which an armpit is unambiguous. It is 2 on
/// nineteen bodies of twenty, and was less than 0.8 for every armpit that was over 6 % of the stature off.
constexpr double kClearMargin = 1.8;
/// The largest correction that a calibration body needs is .027 of the body size.
constexpr double kFarthest = 0.03;
/// One armpit in a hundred that is right exceeds these differences, as fractions of the body size.
constexpr double kMaxDifference = 0.08, kMaxAsymmetry = 0.08;
/// The number of measures of the arm's direction, which are not limited.
constexpr std::size_t kOfArm = 8;

FoundLandmark find(const LandmarkInput& input, int side) {
  const ArmpitSignature found = find_armpit(input.context, input.skin, input.coordinates, side);
  const double confidence = confidence_of(static_cast<double>(found.mahalanobis), kNoEvidence) *
                            std::min(1.0, static_cast<double>(found.margin) / kClearMargin);
  return {{body::of_side(LandmarkId::kArmpitL, side), found.position, found.vertex, confidence}, {}};
}

/// The measures that predict the armpit's correction, in order. First the direction of the arm, and the
/// products of its coordinates except the first's square. Then the build. Then, as fractions of the body
/// size, the distance of the armpits, and the vectors from the armpit to neck, breastbone and back.
std::vector<double> arm_measures(const LandmarkInput& input, const Landmarks& marks, int side,
                                 const TrunkFrame& frame) {
  const double size = input.size_m();
  const Vec3& armpit = marks.at(LandmarkId::kArmpitL, side);
  const Vec3 arm = frame.coordinates((marks.at(LandmarkId::kElbowL, side) - armpit).normalized());
  std::vector<double> measures{arm.x(),           arm.y(),           arm.z(),           arm.x() * arm.y(),
                               arm.x() * arm.z(), arm.y() * arm.y(), arm.y() * arm.z(), arm.z() * arm.z()};
  for (const float length : build_of(input.coordinates)) measures.push_back(static_cast<double>(length));
  measures.push_back((marks.at(LandmarkId::kArmpitL) - marks.at(LandmarkId::kArmpitR)).norm() / size);
  const Midline& middle = input.coordinates.midline();
  for (const Vec3& to : {marks.at(LandmarkId::kNeck), middle.front.position, middle.back.position})
    for (const double part : frame.coordinates(to - armpit)) measures.push_back(part / size);
  limit_measures(input, body::of_side(LandmarkId::kArmpitL, side),
                 {{"least", data::kLeast}, {"most", data::kMost}}, std::span(measures).subspan(kOfArm));
  return measures;
}

/// Corrects the armpit by the direction of the arm and the build of the trunk. An arm that is raised or
/// reaches forward moves the fold behind it, which distances along the skin show only in part.
FoundLandmark refine(const LandmarkInput& input, const Landmarks& marks, int side) {
  FoundLandmark armpit = marks[body::of_side(LandmarkId::kArmpitL, side)];
  if (input.fused()) return armpit;
  TrunkFrame frame = trunk_frame(marks);
  if (side == 1) frame.left = -frame.left;  // outward
  const std::vector<double> measures = arm_measures(input, marks, side, frame);
  armpit.mark.position = corrected(input, {armpit.mark.id,
                                           armpit.mark.position,
                                           {{frame.left, measures, {"outward", data::kOutward}},
                                            {frame.up, measures, {"upward", data::kUpward}},
                                            {frame.forward, measures, {"forward", data::kForward}}},
                                           kFarthest})
                             .position;
  return armpit;
}

float from_hand(const LandmarkInput& input, const Landmarks& marks, int side) {
  return (*input.tips().from_hand[side])[marks[body::of_side(LandmarkId::kArmpitL, side)].mark.vertex];
}

/// The distance of the armpit from the level where the loop around the arm widens into the trunk, along the
/// arm.
double level_difference(const LandmarkInput& input, const Landmarks& marks, int side) {
  const float level = input.coordinates.shoulder_level_m(side);
  if (!(level > 0.0F)) return -1.0;
  return static_cast<double>(std::abs(from_hand(input, marks, side) - level) / input.coordinates.size_m());
}

/// The difference of the paths along both arms, which are of one length. A shrug or a twist changes them by
/// half of what counts as a contradiction.
double asymmetry(const LandmarkInput& input, const Landmarks& marks, int) {
  const float left = from_hand(input, marks, 0), right = from_hand(input, marks, 1);
  return static_cast<double>(std::abs(left - right) / input.coordinates.size_m());
}

}  // namespace
}  // namespace of_armpit

LandmarkKind armpit() {
  return {
      .id = LandmarkId::kArmpitL,
      .paired = true,
      .part = body::Part::kUpperArmL,
      .find = of_armpit::find,
      .refine = of_armpit::refine,
      .checks = {{{of_armpit::level_difference, of_armpit::kMaxDifference,
                   "The armpit and the level where the arm widens into the trunk lie far from each other."},
                  {of_armpit::asymmetry, of_armpit::kMaxAsymmetry, nullptr}}},
      .warn_uncertain = true,
      .doubt = 1,
      .on_skin = true,
      .recipe = Recipe::kCorrections};
}

}  // namespace bodice::anatomy
