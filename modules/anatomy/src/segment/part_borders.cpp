#include "segment/part_borders.hpp"

#include <algorithm>
#include <cmath>

#include <coefficients/part_borders.hpp>

#include "coordinates/build.hpp"

namespace bodice::anatomy {
namespace {

namespace data = coefficients::part_borders;

/// The build of the calibration bodies in the middle, how builds spread, and how many deviations off nothing
/// more is known.
constexpr Build kMiddle = to_floats(data::kBuildMiddle), kSpread = to_floats(data::kBuildSpread);
constexpr float kMostOff = 2.5F;

/// What a deviation of each measure of the build adds to each weight of a border.
using FollowsBuild = std::array<Border, std::tuple_size_v<Build>>;

constexpr std::size_t kWeights = kCoordinateCount + 1;

constexpr FollowsBuild follows(const double (&values)[std::tuple_size_v<Build> * kWeights]) {
  FollowsBuild borders{};
  for (std::size_t i = 0; i < borders.size(); ++i)
    for (std::size_t k = 0; k < kWeights; ++k)
      borders[i].weight[k] = static_cast<float>(values[i * kWeights + k]);
  return borders;
}

constexpr FollowsBuild kNeckFollows = follows(data::kNeckFollows),
                       kShoulderFollows = follows(data::kShoulderFollows),
                       kKneeFollows = follows(data::kKneeFollows), kHipFollows = follows(data::kHipFollows),
                       kWaistFollows = follows(data::kWaistFollows);

/// In deviations from the middle.
Build deviations(Build build) {
  for (std::size_t i = 0; i < build.size(); ++i) {
    const float off = (build[i] - kMiddle[i]) / kSpread[i];
    build[i] = std::isfinite(off) ? std::clamp(off, -kMostOff, kMostOff) : 0.0F;
  }
  return build;
}

Border on_build(const double (&weights)[kWeights], const FollowsBuild& follows, const Build& off) {
  Border border{to_floats(weights)};
  for (std::size_t i = 0; i < off.size(); ++i)
    for (std::size_t k = 0; k < border.weight.size(); ++k) border.weight[k] += off[i] * follows[i].weight[k];
  return border;
}

}  // namespace

PartBorders part_borders(const BodyCoordinates& coordinates) {
  const Build off = deviations(build_of(coordinates));
  return {on_build(data::kNeck, kNeckFollows, off),
          on_build(data::kShoulder, kShoulderFollows, off),
          {to_floats(data::kElbow)},
          on_build(data::kKnee, kKneeFollows, off),
          on_build(data::kHip, kHipFollows, off),
          on_build(data::kWaist, kWaistFollows, off)};
}

}  // namespace bodice::anatomy
