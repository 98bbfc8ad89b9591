#include "landmarks/kinds/perineum_by_legs.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include <coefficients/perineum.hpp>

#include "coordinates/build.hpp"
#include "landmarks/base/trunk_frame.hpp"

namespace bodice::inline v0_1::anatomy {
namespace {

using geometry::Vec3;
namespace data = coefficients::perineum;

/// The frame of the trunk with its origin in the perineum's first estimate; lengths are fractions of the body
/// size.
struct Trunk {
  TrunkFrame frame;
  Vec3 origin;
  double size_m;

  Vec3 coordinates(const Vec3& p) const { return frame.coordinates(p - origin) / size_m; }
};

/// The directions of both thighs: how far outward, up and forward each points.
struct Thighs {
  std::array<Vec3, 2> of_side;
  double mean(int axis) const { return 0.5 * (of_side[0][axis] + of_side[1][axis]); }
  double differ(int axis) const { return of_side[0][axis] - of_side[1][axis]; }
};
enum Axis { kOutAxis, kUpAxis, kAheadAxis };

/// The largest correction, which one body in a thousand exceeds; a fraction of the body size.
constexpr double kLargestCorrection = 0.04;
/// The sum of the distances from breastbone and back to where the legs merge, on a body of middle build; a
/// fraction of the body size.
constexpr double kMiddleTrunk = 0.6856;

Thighs thighs_of(const Trunk& trunk, const Landmarks& marks) {
  Thighs thighs;
  for (int side = 0; side < 2; ++side) {
    thighs.of_side[side] = trunk.coordinates(marks.at(LandmarkId::kKneeL, side)).normalized();
    if (side == 1) thighs.of_side[side].x() = -thighs.of_side[side].x();
  }
  return thighs;
}

/// How much longer than on a body of middle build the front and back of the trunk are; a fraction of the body
/// size.
double heaviness(const BodyCoordinates& coordinates) {
  return static_cast<double>((coordinates.front_to_merge_m() + coordinates.back_to_merge_m()) /
                             coordinates.size_m()) -
         kMiddleTrunk;
}

/// The measures that a mirror image does not change. First the thighs' mean directions, the amounts by which
/// they differ, and squares and products of these, also with the heaviness of the trunk. Then the build. Then
/// upward and forward coordinates: of the merge of the legs, of the estimate by distances, and of breastbone
/// and back.
std::vector<double> even_measures(const LandmarkInput& input, const Trunk& trunk, const Thighs& thighs) {
  const BodyCoordinates& coordinates = input.coordinates;
  const double ahead = thighs.mean(kAheadAxis), up = thighs.mean(kUpAxis), out = thighs.mean(kOutAxis);
  const double aheads = std::abs(thighs.differ(kAheadAxis)), ups = std::abs(thighs.differ(kUpAxis));
  const double heavy = heaviness(coordinates);
  std::vector<double> x{ahead,
                        up,
                        out,
                        aheads,
                        ups,
                        aheads * aheads,
                        ups * ups,
                        ahead * ahead,
                        up * up,
                        out * out,
                        ahead * up,
                        heavy * ahead,
                        heavy * up,
                        heavy * aheads,
                        heavy * aheads * aheads,
                        heavy * ups * ups};
  for (const float length : build_of(coordinates)) x.push_back(static_cast<double>(length));
  for (const Vec3& to : {coordinates.leg_merge().at.position, coordinates.perineum_position()}) {
    x.push_back(trunk.coordinates(to).y());
    x.push_back(trunk.coordinates(to).z());
  }
  const Vec3 front = trunk.coordinates(coordinates.midline().front.position),
             back = trunk.coordinates(coordinates.midline().back.position);
  x.insert(x.end(), {front.z(), back.z(), front.y(), back.y()});
  limit_measures(input, LandmarkId::kPerineum, {{"least", data::kLeast}, {"most", data::kMost}}, x);
  return x;
}

/// The measures that change sign in a mirror image. First the differences of the thighs' directions, and
/// their products with the heaviness of the trunk and with their means. Then leftward coordinates: of the
/// merge of the legs, of the estimate by distances, and of the middle between breastbone and back.
std::vector<double> odd_measures(const LandmarkInput& input, const Trunk& trunk, const Thighs& thighs) {
  const BodyCoordinates& coordinates = input.coordinates;
  const double ahead = thighs.differ(kAheadAxis), up = thighs.differ(kUpAxis);
  const double heavy = heaviness(coordinates);
  const Midline& middle = coordinates.midline();
  std::vector<double> x{
      ahead,
      up,
      thighs.differ(kOutAxis),
      heavy * ahead,
      heavy * up,
      ahead * thighs.mean(kAheadAxis),
      up * thighs.mean(kUpAxis),
      trunk.coordinates(coordinates.leg_merge().at.position).x(),
      trunk.coordinates(coordinates.perineum_position()).x(),
      0.5 * (trunk.coordinates(middle.front.position).x() + trunk.coordinates(middle.back.position).x())};
  std::array<double, std::size(data::kMostOdd)> least{};
  std::transform(std::begin(data::kMostOdd), std::end(data::kMostOdd), least.begin(), std::negate<>());
  limit_measures(input, LandmarkId::kPerineum, {{"", least}, {"most_odd", data::kMostOdd}}, x);
  return x;
}

}  // namespace

Corrected perineum_by_legs(const LandmarkInput& input, const Landmarks& marks) {
  const Vec3& first = marks.at(LandmarkId::kPerineum);
  if (input.fused() || !input.coordinates.leg_merge().at.found()) return {first, 0.0};
  const Trunk trunk{trunk_frame(marks), first, input.size_m()};
  const Thighs thighs = thighs_of(trunk, marks);
  const std::vector<double> even = even_measures(input, trunk, thighs);
  const std::vector<double> odd = odd_measures(input, trunk, thighs);
  return corrected(input, {LandmarkId::kPerineum,
                           first,
                           {{trunk.frame.left, odd, {"leftward", data::kLeftward}, true},
                            {trunk.frame.up, even, {"upward", data::kUpward}},
                            {trunk.frame.forward, even, {"forward", data::kForward}}},
                           kLargestCorrection});
}

}  // namespace bodice::anatomy
