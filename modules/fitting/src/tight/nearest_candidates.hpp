// The few ellipsoids that can be the nearest of a sample, found for blocks of neighboring samples at once.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/closest_point_batch.hpp"

namespace bodice::fitting {

/// Samples of a block: neighbors in space, whose lists are found together.
inline constexpr std::size_t kSampleBlock = 32;

/// Feet of one point on all ellipsoids; ellipsoid k's are at k * stride.
struct CenterFeet {
  const float* d = nullptr;                 ///< signed distances
  std::array<const float*, 3> normal = {};  ///< outward, unit
  std::size_t stride = 1;
};

/// A block's samples and the ball that holds them.
struct SampleBlock {
  std::size_t count = 0;                ///< of samples, at most kSampleBlock
  std::array<const float*, 3> at = {};  ///< x, y, z
  const float* from_center = nullptr;   ///< distance of each sample to the ball's center
  std::array<float, 3> center = {};     ///< of the ball
  CenterFeet feet;                      ///< of the center
};

/// Works on one block at a time; kept between blocks for its memory.
class NearestCandidates {
 public:
  static constexpr int kMost = 8;

  /// For each sample those ellipsoids that are within `reach` of its nearest one, ascending by distance, up
  /// to kMost.
  void find(std::span<const FootEllipsoid> ellipsoids, const SampleBlock& block, float reach);

  int count(std::size_t sample) const { return count_[sample]; }
  const std::array<std::uint32_t, kMost>& of(std::size_t sample) const { return found_[sample]; }
  const std::array<float, kMost>& distances(std::size_t sample) const { return at_[sample]; }

 private:
  using Lanes = std::array<float, kSampleBlock>;

  void load(const SampleBlock& block);
  /// Whether ellipsoid k, at distance d from the ball's center, can be within reach of some sample's nearest.
  /// Signed distances to convex bodies are convex: none lies below its tangent at the center.
  bool may_reach(const SampleBlock& block, std::uint32_t k, float d, const Lanes& least, float reach) const;
  void sort_by_ball(std::size_t ellipsoids, const SampleBlock& block, float reach);
  Lanes measure(std::span<const FootEllipsoid> ellipsoids, const SampleBlock& block, float reach);
  void insert(std::size_t sample, std::uint32_t ellipsoid, float distance);

  std::array<Lanes, 3> from_;  ///< the samples less the ball's center
  std::vector<std::pair<float, std::uint32_t>> order_;
  std::vector<std::uint32_t> ellipsoid_;  ///< #C that may be within reach somewhere in the block
  std::vector<Lanes> distance_;           ///< at least #C
  std::array<std::array<std::uint32_t, kMost>, kSampleBlock> found_;
  std::array<std::array<float, kMost>, kSampleBlock> at_;
  std::array<int, kSampleBlock> count_;
};

}  // namespace bodice::fitting
