#include "segment/part_borders.hpp"

#include <algorithm>
#include <cmath>

#include <coefficients/part_borders.hpp>

namespace bodice::inline v0_1::anatomy {
namespace {

namespace border_data = coefficients::part_borders;

/// The build of the calibration bodies in the middle, how builds spread, and how many deviations off nothing
/// more is known.
constexpr Build kMiddleBuild = to_floats(border_data::kBuildMiddle),
                kBuildSpread = to_floats(border_data::kBuildSpread);
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

constexpr FollowsBuild kNeckFollows = follows(border_data::kNeckFollows),
                       kShoulderFollows = follows(border_data::kShoulderFollows),
                       kKneeFollows = follows(border_data::kKneeFollows),
                       kHipFollows = follows(border_data::kHipFollows),
                       kWaistFollows = follows(border_data::kWaistFollows);

/// A build as deviations from the middle.
struct Deviations {
  Build off;          ///< clamped to kMostOff
  bool known = true;  ///< false where a measure was farther off, as on a body that is welded at the arms
};
Deviations deviations(const Build& build) {
  Deviations result;
  for (std::size_t i = 0; i < build.size(); ++i) {
    const float off = (build[i] - kMiddleBuild[i]) / kBuildSpread[i];
    result.off[i] = std::isfinite(off) ? std::clamp(off, -kMostOff, kMostOff) : 0.0F;
    result.known = result.known && std::isfinite(off) && std::abs(off) <= kMostOff;
  }
  return result;
}

Border on_build(const double (&weights)[kWeights], const FollowsBuild& follows, const Build& off) {
  Border border{to_floats(weights)};
  for (std::size_t i = 0; i < off.size(); ++i)
    for (std::size_t k = 0; k < border.weight.size(); ++k) border.weight[k] += off[i] * follows[i].weight[k];
  return border;
}

/// The border at a share of the path from one border to another, since scores are distances from their
/// borders.
Border between(const Border& below, const Border& above, float share) {
  Border border{};
  for (std::size_t k = 0; k < border.weight.size(); ++k)
    border.weight[k] = (1.0F - share) * below.weight[k] + share * above.weight[k];
  return border;
}

}  // namespace

PartBorders part_borders(const Build& build) {
  const auto [off, known] = deviations(build);
  const Border neck = on_build(border_data::kNeck, kNeckFollows, off),
               waist = on_build(border_data::kWaist, kWaistFollows, off);
  // The border of landmarks is the same for all builds, and errs less where the build is not known.
  return {known ? neck : kNeck,
          on_build(border_data::kShoulder, kShoulderFollows, off),
          {to_floats(border_data::kElbow)},
          on_build(border_data::kKnee, kKneeFollows, off),
          on_build(border_data::kHip, kHipFollows, off),
          waist,
          between(waist, neck, static_cast<float>(border_data::kChestShare[0]))};
}

}  // namespace bodice::anatomy
