// The few ellipsoids that can be the nearest of a sample, found for blocks of neighbouring samples at once.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "foot_batch.hpp"

namespace bodice::fitting {

/// Samples of a block: neighbours in space, whose lists are found together.
inline constexpr std::size_t kSampleBlock = 32;

/// A block's samples and the ball that holds them.
struct SampleBlock {
  std::size_t count = 0;  ///< of samples, at most kSampleBlock
  const float *x = nullptr, *y = nullptr, *z = nullptr;
  const float* from_centre = nullptr;  ///< distance of each sample to the ball's centre
  std::span<const float> of_ball;      ///< #E distances of the ball's centre to the ellipsoids
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

  void sort_by_ball(const SampleBlock& block, float reach);
  Lanes measure(std::span<const FootEllipsoid> ellipsoids, const SampleBlock& block, float reach);
  void insert(std::size_t sample, std::uint32_t ellipsoid, float distance);

  std::vector<std::pair<float, std::uint32_t>> order_;
  std::vector<std::uint32_t> ellipsoid_;  ///< #C that may be within reach somewhere in the block
  std::vector<Lanes> distance_;           ///< at least #C
  std::array<std::array<std::uint32_t, kMost>, kSampleBlock> found_;
  std::array<std::array<float, kMost>, kSampleBlock> at_;
  std::array<int, kSampleBlock> count_;
};

}  // namespace bodice::fitting
