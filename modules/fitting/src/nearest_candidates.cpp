#include "nearest_candidates.hpp"

#include <algorithm>
#include <bit>
#include <limits>

#include "vector_clones.hpp"

namespace bodice::fitting {
namespace {

constexpr std::size_t kLanes = kSampleBlock;

constexpr std::array<std::uint32_t, kLanes> kBit = [] {
  std::array<std::uint32_t, kLanes> bit{};
  for (std::size_t i = 0; i < kLanes; ++i) bit[i] = 1u << i;
  return bit;
}();

}  // namespace

BODICE_CLONES static void lower(const float* __restrict d, float* __restrict least) {
  for (std::size_t i = 0; i < kLanes; ++i) least[i] = d[i] < least[i] ? d[i] : least[i];
}

/// Bit i: d[i] <= most[i].
BODICE_CLONES static std::uint32_t at_most(const float* __restrict d, const float* __restrict most,
                                           const std::uint32_t* __restrict bit) {
  std::uint32_t mask = 0;
  for (std::size_t i = 0; i < kLanes; ++i) mask |= d[i] <= most[i] ? bit[i] : 0u;
  return mask;
}

/// Signed distances are 1-Lipschitz: one whose distance from the ball's centre is above this is within reach
/// of no sample's nearest.
static float enough(const SampleBlock& block, const float* nearest, float reach) {
  float most = -std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i < block.count; ++i) most = std::max(most, nearest[i] + block.from_centre[i]);
  return most + reach;
}

/// By their distance to the ball's centre, those that may be near enough.
void NearestCandidates::sort_by_ball(const SampleBlock& block, float reach) {
  const float nearest = *std::ranges::min_element(block.of_ball);
  const float radius = *std::max_element(block.from_centre, block.from_centre + block.count);
  order_.clear();
  for (std::uint32_t k = 0; k < block.of_ball.size(); ++k)
    if (block.of_ball[k] <= nearest + 2.0f * radius + reach) order_.push_back({block.of_ball[k], k});
  std::ranges::sort(order_);
}

/// Distances of all samples to the ellipsoids that may be within reach of one; returns each sample's least.
NearestCandidates::Lanes NearestCandidates::measure(std::span<const FootEllipsoid> ellipsoids,
                                                    const SampleBlock& block, float reach) {
  Lanes least;
  least.fill(std::numeric_limits<float>::infinity());
  ellipsoid_.clear();
  float most = std::numeric_limits<float>::infinity();
  for (const auto& [of_ball, k] : order_) {
    if (of_ball > most) break;
    if (distance_.size() == ellipsoid_.size()) distance_.emplace_back();
    Lanes& d = distance_[ellipsoid_.size()];
    ellipsoid_.push_back(k);
    foot_distances(ellipsoids[k], block.count, block.x, block.y, block.z, d.data());
    std::fill(d.begin() + static_cast<std::ptrdiff_t>(block.count), d.end(), 0.0f);
    lower(d.data(), least.data());
    most = enough(block, least.data(), reach);
  }
  return least;
}

void NearestCandidates::find(std::span<const FootEllipsoid> ellipsoids, const SampleBlock& block,
                             float reach) {
  sort_by_ball(block, reach);
  Lanes limit = measure(ellipsoids, block, reach);
  for (float& l : limit) l += reach;
  count_.fill(0);
  const std::uint32_t samples = ~0u >> (kLanes - block.count);
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
