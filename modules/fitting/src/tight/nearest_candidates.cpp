#include "tight/nearest_candidates.hpp"

#include <algorithm>
#include <bit>
#include <limits>

#include "base/vector_clones.hpp"

namespace bodice::inline v0_1::fitting {
namespace {

constexpr std::size_t kSampleLanes = kSampleBlock;
constexpr float kRounding = 1e-5f;  // bound on the rounding of distances, in scaled units

constexpr std::array<std::uint32_t, kSampleLanes> kBit = [] {
  std::array<std::uint32_t, kSampleLanes> bit{};
  for (std::size_t i = 0; i < kSampleLanes; ++i) bit[i] = 1u << i;
  return bit;
}();

}  // namespace

BODICE_CLONES static void lower(const float* __restrict d, float* __restrict least) {
  for (std::size_t i = 0; i < kSampleLanes; ++i) least[i] = d[i] < least[i] ? d[i] : least[i];
}

/// A linear function: its value at the origin and its slopes.
struct Tangent {
  float at_origin;
  std::array<float, 3> slope;
};

/// Whether the function is at most most[i] at some point i.
BODICE_CLONES static bool tangent_reaches(const Tangent& tangent, const float* __restrict x,
                                          const float* __restrict y, const float* __restrict z,
                                          const float* __restrict most) {
  const float height = tangent.at_origin, sx = tangent.slope[0], sy = tangent.slope[1], sz = tangent.slope[2];
  unsigned below = 0;
  for (std::size_t i = 0; i < kSampleLanes; ++i)
    below |= height + sx * x[i] + sy * y[i] + sz * z[i] <= most[i] ? 1u : 0u;
  return below != 0;
}

/// A mask in which bit i is set if d[i] <= most[i].
BODICE_CLONES static std::uint32_t at_most(const float* __restrict d, const float* __restrict most,
                                           const std::uint32_t* __restrict bit) {
  std::uint32_t mask = 0;
  for (std::size_t i = 0; i < kSampleLanes; ++i) mask |= d[i] <= most[i] ? bit[i] : 0u;
  return mask;
}

/// Signed distances are 1-Lipschitz, so that an ellipsoid farther than this from the ball's center is beyond
/// `reach` of every sample's nearest distance.
static float enough(const SampleBlock& block, const float* nearest, float reach) {
  float most = -std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i < block.count; ++i) most = std::max(most, nearest[i] + block.from_center[i]);
  return most + reach;
}

/// Sorts the ellipsoids that may be near enough by their distance to the ball's center.
void NearestCandidates::sort_by_ball(std::size_t ellipsoids, const SampleBlock& block, float reach) {
  const auto of_ball = [&](std::size_t k) { return block.from_ball.d[k * block.from_ball.stride]; };
  float nearest = std::numeric_limits<float>::infinity();
  for (std::size_t k = 0; k < ellipsoids; ++k) nearest = std::min(nearest, of_ball(k));
  const float radius = *std::max_element(block.from_center, block.from_center + block.count);
  order_.clear();
  for (std::uint32_t k = 0; k < ellipsoids; ++k)
    if (of_ball(k) <= nearest + 2.0f * radius + reach) order_.push_back({of_ball(k), k});
  std::ranges::sort(order_);
}

/// Loads the samples' offsets from the ball's center; lanes beyond the samples repeat the last sample.
void NearestCandidates::load(const SampleBlock& block) {
  for (std::size_t j = 0; j < 3; ++j)
    for (std::size_t i = 0; i < kSampleLanes; ++i)
      from_[j][i] = block.at[j][std::min(i, block.count - 1)] - block.center[j];
}

bool NearestCandidates::may_reach(const SampleBlock& block, std::uint32_t k, float d, const Lanes& least,
                                  float reach) const {
  const auto normal = [&](std::size_t j) { return block.from_ball.normal[j][k * block.from_ball.stride]; };
  return tangent_reaches({d - reach - kRounding, {normal(0), normal(1), normal(2)}}, from_[0].data(),
                         from_[1].data(), from_[2].data(), least.data());
}

/// Measures all samples' distances to the ellipsoids that may be within reach of one; returns each sample's
/// least one.
NearestCandidates::Lanes NearestCandidates::measure(std::span<const FloatEllipsoid> ellipsoids,
                                                    const SampleBlock& block, float reach) {
  Lanes least;
  least.fill(std::numeric_limits<float>::infinity());
  ellipsoid_.clear();
  float most = std::numeric_limits<float>::infinity();
  for (const auto& [of_ball, k] : order_) {
    if (of_ball > most) break;
    if (!may_reach(block, k, of_ball, least, reach)) continue;
    if (distance_.size() == ellipsoid_.size()) distance_.emplace_back();
    Lanes& d = distance_[ellipsoid_.size()];
    ellipsoid_.push_back(k);
    batch_distances(ellipsoids[k], {block.count, block.at[0], block.at[1], block.at[2]}, d.data());
    std::fill(d.begin() + static_cast<std::ptrdiff_t>(block.count), d.end(), d[block.count - 1]);
    lower(d.data(), least.data());
    most = enough(block, least.data(), reach);
  }
  return least;
}

void NearestCandidates::find(std::span<const FloatEllipsoid> ellipsoids, const SampleBlock& block,
                             float reach) {
  load(block);
  sort_by_ball(ellipsoids.size(), block, reach);
  Lanes limit = measure(ellipsoids, block, reach);
  for (float& l : limit) l += reach;
  count_.fill(0);
  const std::uint32_t samples = ~0u >> (kSampleLanes - block.count);
  for (std::size_t c = 0; c < ellipsoid_.size(); ++c) {
    std::uint32_t mask = samples & at_most(distance_[c].data(), limit.data(), kBit.data());
    for (; mask != 0; mask &= mask - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(mask));
      insert(i, ellipsoid_[c], distance_[c][i]);
    }
  }
}

void NearestCandidates::insert(std::size_t sample, std::uint32_t ellipsoid, float distance) {
  auto& at = at_[sample];
  auto& found = found_[sample];
  int& count = count_[sample];
  if (count == kMost && distance >= at[kMost - 1]) return;
  int slot = count < kMost ? count++ : kMost - 1;
  for (; slot > 0 && distance < at[slot - 1]; --slot) at[slot] = at[slot - 1], found[slot] = found[slot - 1];
  at[slot] = distance;
  found[slot] = ellipsoid;
}

}  // namespace bodice::fitting
