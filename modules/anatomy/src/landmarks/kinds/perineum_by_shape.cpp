#include "landmarks/kinds/perineum_by_shape.hpp"

#include <algorithm>
#include <cmath>

#include <coefficients/perineum.hpp>

#include "coordinates/crotch_line.hpp"
#include "landmarks/base/correction.hpp"

namespace bodice::inline v0_1::anatomy {
namespace {

using geometry::Vec3;
namespace data = coefficients::perineum;

/// The points of the line that are measured, from front to back, in multiples of its spacing.
constexpr std::array<int, 10> kReadAt{-10, -8, -6, -4, -2, 2, 4, 6, 8, 10};
/// The chord from the point this far in front to that as far behind defines the forward direction.
constexpr int kChord = 9;

using Shape = std::array<double, 2 * kReadAt.size()>;

/// The largest shift that a calibration body needs is .037 of the body size.
constexpr double kMostShift = 0.04;

/// How far behind the first estimate the perineum lies, as a fraction of the body size. The weights are a
/// constant, then one for each point's depth below the first estimate, then one for its distance in front of
/// it. There are weights for bent legs, and others that are added for straight legs.
double shift_on(const Shape& shape, std::span<const double> weights) {
  double sum = weights[0];
  for (std::size_t i = 0; i < shape.size(); ++i) sum += weights[i + 1] * shape[i];
  return sum;
}

Shape shape_of(const CrotchLine& line, double size) {
  const Vec3 &front = line.at(-kChord), &back = line.at(kChord);
  Vec3 middle = Vec3::Zero();
  for (int i = -kChord; i <= kChord; ++i) middle += line.at(i) / (2 * kChord + 1);
  const Vec3 forward = (front - back).normalized();
  const Vec3 sag = middle - 0.5 * (front + back);
  const Vec3 down = (sag - sag.dot(forward) * forward).normalized();
  Shape shape{};
  for (std::size_t i = 0; i < kReadAt.size(); ++i) {
    const Vec3 off = (line.at(kReadAt[i]) - line.at(0)) / size;
    shape[i] = off.dot(down);
    shape[kReadAt.size() + i] = off.dot(forward);
  }
  return shape;
}

/// A weight: 0 if a thigh is at a right angle to the trunk or more, 1 if both thighs continue the trunk.
double straightness(const Landmarks& marks) {
  constexpr double kBentCosine = 0.2, kStraightCosine = 0.8;
  const Vec3& perineum = marks.at(LandmarkId::kPerineum);
  const Vec3 up = (marks.at(LandmarkId::kNeck) - perineum).normalized();
  double cosine = 1.0;
  for (int side = 0; side < 2; ++side)
    cosine = std::min(cosine, -(marks.at(LandmarkId::kKneeL, side) - perineum).normalized().dot(up));
  return std::clamp((cosine - kBentCosine) / (kStraightCosine - kBentCosine), 0.0, 1.0);
}

/// The point of the line this far behind its middle one, a fraction of the body size.
Vec3 point_behind(const CrotchLine& line, double shift) {
  const double steps = shift / CrotchLine::kSpacing;
  const int before = static_cast<int>(std::floor(steps));
  return line.at(before) + (steps - before) * (line.at(before + 1) - line.at(before));
}

/// The shift as a correction along a line that is straight near its middle.
Correction along_line(const CrotchLine& line, const Vec3& first, const Shape& shape, double straight) {
  const Vec3 back = (line.at(1) - line.at(-1)).normalized();
  const std::vector<double> measures(shape.begin(), shape.end());
  return {LandmarkId::kPerineum,
          first,
          {{back, measures, {"bent", data::kBent}},
           {straight * back, measures, {"straighter", data::kStraighter}}},
          kMostShift};
}

}  // namespace

Vec3 perineum_by_shape(const LandmarkInput& input, const Landmarks& marks) {
  const Vec3& first = marks.at(LandmarkId::kPerineum);
  const auto line = crotch_line(input.skin, input.coordinates, first);
  if (!line) return first;
  const Shape shape = shape_of(*line, input.size_m());
  const double straight = straightness(marks);
  const auto shift_by = [&](const Coefficients& weights) {
    return shift_on(shape, values_of(input, LandmarkId::kPerineum, weights));
  };
  const double shift =
      shift_by({"bent", data::kBent}) + straight * shift_by({"straighter", data::kStraighter});
  record(input, along_line(*line, first, shape, straight));
  if (!std::isfinite(shift)) return first;
  return first + point_behind(*line, std::clamp(shift, -kMostShift, kMostShift)) - line->at(0);
}

}  // namespace bodice::anatomy
