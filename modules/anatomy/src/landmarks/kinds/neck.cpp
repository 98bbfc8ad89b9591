// Based on: the paper, section 2.1 (the neck at the least girth of the isolines around the head)
// Differs: that girth is the cross-check; the landmark is the joint at the lower end of the neck.
#include <cmath>

#include <coefficients/neck.hpp>

#include "coordinates/body_lengths.hpp"
#include "landmarks/base/border_loop.hpp"
#include "landmarks/base/correction.hpp"
#include "landmarks/base/landmark_kind.hpp"
#include "skin/curve.hpp"
#include "skin/girth_profile.hpp"

namespace bodice::inline v0_1::anatomy {
namespace of_neck {
namespace {

using geometry::Vec3;
namespace data = coefficients::neck;

/// The distance from the crown beyond which the border's sign means nothing; a fraction of the body size.
constexpr float kReach = 0.40F;
/// A wider loop is not the neck's: it runs over the shoulders. A fraction of the body size.
constexpr double kWidestNeck = 0.6;
/// No limit on the share of the distance to another point.
constexpr double kAnyShare = 1.0;
/// The largest correction that a calibration body needs is .026 of the body size.
constexpr double kFarthest = 0.03;
/// The range of distances from the crown in which the narrowest neck may be, wide enough for children;
/// fractions of the body size.
constexpr float kNeckFrom = 0.11F, kNeckTo = 0.40F;
constexpr std::size_t kSteps = 58;
/// The joint and the narrowest neck lie some 4 % of the body size apart; one neck in a hundred that is right
/// exceeds this difference.
constexpr double kMaxDifference = 0.10;

FoundLandmark find(const LandmarkInput& input, int) {
  FoundLandmark neck;
  neck.loop = border_loop(input.skin, input.coordinates, {kNeck, kFromHead, kReach}, 0);
  neck.mark = {LandmarkId::kNeck, neck.loop.center, neck.loop.vertex, neck.loop.confidence};
  return neck;
}

/// The axes of the neck: up from the trunk along it, and forward across it.
struct NeckAxes {
  Vec3 up, forward;
};

NeckAxes neck_axes(const LandmarkInput& input, const Vec3& neck, const Vec3& perineum) {
  const Vec3 up = (neck - perineum).normalized();
  const Midline& middle = input.coordinates.midline();
  const Vec3 through = middle.front.position - middle.back.position;
  return {up, (through - through.dot(up) * up).normalized()};
}

/// The joint by the body's lengths and the head's radius, from between the loop, the armpits and the head:
/// the loop alone follows the chin of a large head and the folds of a nape that is bent back. A fused skin
/// may have wrong armpits, so that there the loop alone counts.
Vec3 joint_by_lengths(const LandmarkInput& input, const Landmarks& marks) {
  const Vec3& loop = marks[LandmarkId::kNeck].loop.center;
  const Vec3& perineum = input.skin.mesh.positions[marks[LandmarkId::kPerineum].mark.vertex];
  const NeckAxes axes = neck_axes(input, loop, perineum);
  const BodyLengths lengths = body_lengths(input.coordinates);
  std::vector<double> measures(lengths.begin(), lengths.end());
  const bool has_head = input.head.radius > 0.0;  // not where all of it is taken for something else
  // A calibration that records corrections needs this one as well, although the joint is that by lengths.
  if (input.fused() || !has_head || input.records) {
    const Vec3 by_loop = corrected(input, {LandmarkId::kNeck,
                                           loop,
                                           {{axes.up, measures, {"loop_up", data::kLoopUp}},
                                            {axes.forward, measures, {"loop_forward", data::kLoopForward}}},
                                           kMostByLengths})
                             .position;
    if (input.fused() || !has_head) return by_loop;
  }
  measures.push_back(input.head.radius / input.size_m());
  const Vec3 armpits = 0.5 * (marks.at(LandmarkId::kArmpitL) + marks.at(LandmarkId::kArmpitR));
  const double size = input.size_m();
  const Vec3 first =
      corrected(input, {LandmarkId::kNeck,
                        loop,
                        {{(armpits - loop) / size, {}, {"toward_armpits", data::kTowardArmpits}},
                         {(input.head.center - loop) / size, {}, {"toward_head", data::kTowardHead}}},
                        kAnyShare})
          .position;
  return corrected(input, {LandmarkId::kNeck,
                           first,
                           {{axes.up, measures, {"joint_up", data::kJointUp}},
                            {axes.forward, measures, {"joint_forward", data::kJointForward}}},
                           kMostByLengths})
      .position;
}

/// Lengths as fractions of the body size: the loop's girth, breastbone to back, the loop from breastbone and
/// from back, its level below the crown, armpit to armpit, their middle to the joint, hand to hand, foot to
/// foot.
std::vector<double> neck_measures(const LandmarkInput& input, const Landmarks& marks, const Vec3& joint) {
  const double size = input.size_m();
  const auto of_size = [&](float length_m) { return static_cast<double>(length_m) / size; };
  const Midline& middle = input.coordinates.midline();
  const Loop& loop = marks[LandmarkId::kNeck].loop;
  const Vec3 &left = marks.at(LandmarkId::kArmpitL), &right = marks.at(LandmarkId::kArmpitR);
  std::vector<double> measures{loop.girth_m / size,
                               (middle.front.position - middle.back.position).norm() / size,
                               of_size(loop.from_front),
                               of_size(loop.from_back),
                               of_size(loop.level_m),
                               (left - right).norm() / size,
                               (0.5 * (left + right) - joint).norm() / size,
                               of_size(input.tips().hands_apart),
                               of_size(input.tips().feet_apart)};
  limit_measures(input, LandmarkId::kNeck, {{"least", data::kLeast}, {"most", data::kMost}}, measures);
  return measures;
}

/// Heavy necks and shoulders hide the joint below their flesh: what neck and trunk measure shows how deep.
FoundLandmark refine(const LandmarkInput& input, const Landmarks& marks, int) {
  FoundLandmark neck = marks[LandmarkId::kNeck];
  if (!neck.loop.found()) return neck;
  neck.mark.position = joint_by_lengths(input, marks);
  if (input.fused() || !(neck.loop.girth_m < kWidestNeck * input.size_m())) return neck;
  const NeckAxes axes = neck_axes(input, neck.mark.position, input.coordinates.perineum_position());
  const std::vector<double> measures = neck_measures(input, marks, neck.mark.position);
  neck.mark.position = corrected(input, {LandmarkId::kNeck,
                                         neck.mark.position,
                                         {{axes.up, measures, {"up", data::kUp}},
                                          {axes.forward, measures, {"forward", data::kForward}}},
                                         kFarthest})
                           .position;
  return neck;
}

/// The lowest local minimum of girth between a wider head and wider shoulders; 0 if girth only grows.
float narrowest_level(const GirthProfile& profile) {
  const auto& girth = profile.girth_m;
  std::size_t best = 0;
  for (std::size_t i = 1; i + 1 < girth.size(); ++i) {
    const bool dip = girth[i] <= girth[i - 1] && girth[i] <= girth[i + 1] && girth[i] > 0.0F;
    if (dip && (best == 0 || girth[i] < girth[best])) best = i;
  }
  return best == 0 ? 0.0F : profile.level(best);
}

double difference(const LandmarkInput& input, const Landmarks& marks, int) {
  const geodesic::Field& from_head = *input.tips().from_head;
  const float size = input.coordinates.size_m();
  const float level =
      narrowest_level(girth_profile(input.skin, from_head, kNeckFrom * size, kNeckTo * size, kSteps));
  if (!(level > 0.0F) || !marks[LandmarkId::kNeck].loop.found()) return -1.0;
  const auto lines = geodesic::isolines(input.skin.mesh, input.skin.edges, from_head, {&level, 1})[0];
  const geodesic::Isoline* loop = widest_closed(lines);
  if (loop == nullptr) return -1.0;
  return (loop->centroid - marks.at(LandmarkId::kNeck)).norm() / static_cast<double>(size);
}

}  // namespace
}  // namespace of_neck

LandmarkKind neck() {
  return {.id = LandmarkId::kNeck,
          .part = body::Part::kHead,
          .find = of_neck::find,
          .refine = of_neck::refine,
          .checks = {{{of_neck::difference, of_neck::kMaxDifference,
                       "The neck's border and its narrowest level lie far from each other."}}},
          .warn_uncertain = true,
          .doubt = 2,
          .recipe = Recipe::kCorrections};
}

}  // namespace bodice::anatomy
