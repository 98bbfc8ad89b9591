// The few ellipsoids that can be nearest to a sample, found for blocks of neighboring samples at once.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/closest_point_batch.hpp"

namespace bodice::inline v0_1::fitting {

/// The number of samples in a block; they are neighbors in space, and their candidates are found together.
inline constexpr std::size_t kSampleBlock = 32;

/// Distances of one point to all ellipsoids; those of ellipsoid k are at k * stride.
struct CenterDistances {
  const float* d = nullptr;                 ///< signed distances
  std::array<const float*, 3> normal = {};  ///< outward unit normals at the closest points
  std::size_t stride = 1;
};

/// A block's samples and the ball that holds them.
struct SampleBlock {
  std::size_t count = 0;                ///< number of samples, at most kSampleBlock
  std::array<const float*, 3> at = {};  ///< x, y, z of the samples
  const float* from_center = nullptr;   ///< distance of each sample to the ball's center
  std::array<float, 3> center = {};     ///< the ball's center
  CenterDistances from_ball;            ///< distances of the ball's center
};

/// Finds the candidates of one block at a time. Reuse the object, because it keeps its memory.
class NearestCandidates {
 public:
  static constexpr int kMost = 8;

  /// Finds for each sample the ellipsoids that are at most `reach` farther than the nearest one,
  /// ascending by distance, up to kMost of them.
  void find(std::span<const FloatEllipsoid> ellipsoids, const SampleBlock& block, float reach);

  int count(std::size_t sample) const { return count_[sample]; }
  const std::array<std::uint32_t, kMost>& of(std::size_t sample) const { return found_[sample]; }
  const std::array<float, kMost>& distances(std::size_t sample) const { return at_[sample]; }

 private:
  using Lanes = std::array<float, kSampleBlock>;

  void load(const SampleBlock& block);
  /// Whether ellipsoid k, at distance d from the ball's center, can be within reach of some sample's nearest
  /// distance. Signed distances to convex bodies are convex functions, so that each lies above its tangent at
  /// the center.
  bool may_reach(const SampleBlock& block, std::uint32_t k, float d, const Lanes& least, float reach) const;
  void sort_by_ball(std::size_t ellipsoids, const SampleBlock& block, float reach);
  Lanes measure(std::span<const FloatEllipsoid> ellipsoids, const SampleBlock& block, float reach);
  void insert(std::size_t sample, std::uint32_t ellipsoid, float distance);

  std::array<Lanes, 3> from_;  ///< the samples' offsets from the ball's center
  std::vector<std::pair<float, std::uint32_t>>
      order_;                             ///< distances to the ball's center, with the ellipsoid
  std::vector<std::uint32_t> ellipsoid_;  ///< #C: those that may be within reach somewhere in the block
  std::vector<Lanes> distance_;           ///< #C or more: the samples' distances
  std::array<std::array<std::uint32_t, kMost>, kSampleBlock> found_;
  std::array<std::array<float, kMost>, kSampleBlock> at_;
  std::array<int, kSampleBlock> count_;
};

}  // namespace bodice::fitting
