#include "segment/part_borders.hpp"

#include <algorithm>
#include <cmath>

#include "coordinates/build.hpp"

namespace bodice::anatomy {
namespace {

namespace data = coefficients::borders;

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

Border on_build(Border border, const FollowsBuild& follows, const Build& off) {
  for (std::size_t i = 0; i < off.size(); ++i)
    for (std::size_t k = 0; k < border.weight.size(); ++k) border.weight[k] += off[i] * follows[i].weight[k];
  return border;
}

}  // namespace

PartBorders part_borders(const BodyCoordinates& coordinates) {
  const Build off = deviations(build_of(coordinates));
  return {on_build(kNeck, kNeckFollows, off), on_build(kShoulder, kShoulderFollows, off),
          on_build(kKnee, kKneeFollows, off), on_build(kHip, kHipFollows, off),
          on_build(kWaist, kWaistFollows, off)};
}

}  // namespace bodice::anatomy
