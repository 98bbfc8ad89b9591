#include "landmarks/neck_position.hpp"

#include <algorithm>
#include <cmath>

#include "skin/linear_form.hpp"

namespace bodice::anatomy {
namespace {

using geometry::Vec3;

/// Of the size: the loop's girth, breastbone to back, the loop from breastbone and from back, its level below
/// the head's end, armpit to armpit, their middle to the first answer, hand to hand, foot to foot.
using NeckMeasures = std::array<double, 9>;
using NeckForm = LinearForm<std::tuple_size_v<NeckMeasures>>;

/// How far the joint lies beyond the first answer in one direction, of the size. Least squares without
/// outliers over the calibration bodies and 1,000 made ones; with each build left out in turn, the error
/// falls by a fifth on rig-skinned bodies and by two fifths on made ones.
constexpr NeckForm kUp{{0.1024, 0.1106, 0.0671, -0.3394, -0.0366, -0.1818, -0.0854, 0.3870, 0.0566, -0.1473}};
constexpr NeckForm kForward{
    {-0.0493, 0.0590, 0.0574, -0.0920, 0.0034, -0.0038, -0.0329, -0.0443, 0.0211, 0.0192}};
/// Ninety-eight of a hundred bodies measure between these; beyond, nothing more is learned.
constexpr NeckMeasures kLeast{0.215, 0.050, 0.014, 0.003, 0.149, 0.157, 0.055, 0.851, 0.979};
constexpr NeckMeasures kMost{0.499, 0.185, 0.136, 0.166, 0.279, 0.334, 0.132, 1.078, 1.148};
/// A wider loop is not the neck's: it runs over the shoulders. Of the size.
constexpr double kWidestNeck = 0.6;
/// The largest that any of them needs is .026.
constexpr double kFarthest = 0.03;

NeckMeasures measures_of(const BodyCoordinates& coordinates, const Landmarks& marks) {
  const auto size = static_cast<double>(coordinates.size_m());
  const auto of_size = [&](float length_m) { return static_cast<double>(length_m) / size; };
  const Midline& middle = coordinates.midline();
  const Vec3 &left = marks.armpit_place[0], &right = marks.armpit_place[1];
  NeckMeasures x{marks.neck.girth_m / size,
                 (middle.front.position - middle.back.position).norm() / size,
                 of_size(marks.neck.from_front),
                 of_size(marks.neck.from_back),
                 of_size(marks.neck.level_m),
                 (left - right).norm() / size,
                 (0.5 * (left + right) - marks.neck_place).norm() / size,
                 of_size(coordinates.extremities().hands_apart),
                 of_size(coordinates.extremities().feet_apart)};
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = std::clamp(x[i], kLeast[i], kMost[i]);
  return x;
}

}  // namespace

Vec3 neck_by_measures(const Skin& skin, const BodyCoordinates& coordinates, const Landmarks& marks) {
  const auto size = static_cast<double>(coordinates.size_m());
  const bool neck = marks.neck.vertex != geometry::kNoIndex && marks.neck.girth_m < kWidestNeck * size;
  if (!neck || skin.handles > 0) return marks.neck_place;
  const NeckMeasures x = measures_of(coordinates, marks);
  const double upwards = kUp(x), forwards = kForward(x);
  if (!std::isfinite(upwards + forwards)) return marks.neck_place;
  const Vec3 up = (marks.neck_place - coordinates.perineum_position()).normalized();
  const Vec3 through = coordinates.midline().front.position - coordinates.midline().back.position;
  const Vec3 forward = (through - through.dot(up) * up).normalized();
  return marks.neck_place + size * (std::clamp(upwards, -kFarthest, kFarthest) * up +
                                    std::clamp(forwards, -kFarthest, kFarthest) * forward);
}

}  // namespace bodice::anatomy
