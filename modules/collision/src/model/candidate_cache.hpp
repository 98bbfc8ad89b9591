// The candidate cache: ellipsoids that can own a particle of a batch, stored from call to call.
//
// The distance to an ellipsoid changes by at most the displacement of the particle plus that of the
// ellipsoid's material. An ellipsoid that is farther than the nearest one by `slack` therefore cannot become
// the owner while the two displacements together (`moved`) stay below slack / 2. Stored are the candidates
// with slack <= 2 reach + blend. Evaluated are those with slack <= 2 moved + blend, which are few at first.
// The results have the same bits as among all ellipsoids while moved <= reach.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <bodice/engine/memory_resource.hpp>
#include <bodice/geometry/ellipsoid.hpp>

#include "model/batch.hpp"

namespace bodice::inline v0_1::collision {

/// Cached candidates of one batch.
struct alignas(64) CachedBatch {
  static constexpr int kSpan = 32, kSpans = kBatch / kSpan;  ///< lanes that share candidates
  static constexpr int kCapacity = 32;                       ///< candidates of all spans together
  static constexpr int kLeastUse = 2;                        ///< calls that pay for finding the candidates
  static constexpr int kShortLife = 6,
                       kLongLife = 40;    ///< calls: after fewer the reach grows, after more it shrinks
  static constexpr int kRest = 16;        ///< calls without a cache after a failure
  static constexpr float kFar_m = 1e30f;  ///< meters

  float x[kBatch], y[kBatch], z[kBatch];  ///< positions at the last refresh, meters
  float least_m[kSpans];                  ///< lower bound of the span's distance to any ellipsoid
  /// Lower bound of how much farther than the nearest ellipsoid a candidate was; kFar_m: not near the span.
  alignas(64) float slack_m[kSpans][kCapacity];
  std::int32_t candidate[kCapacity];  ///< internal indices, rising
  int candidates = 0;
  int count = 0;  ///< number of lanes; zero: nothing is cached
  float reach_m = 0.0f;
  float moved_m = 0.0f;     ///< bound on the displacement of particles and material since the refresh
  double traveled_m = 0.0;  ///< CandidateCache::traveled_m() at the refresh
  int used = 0, rest = 0;   ///< numbers of calls

  /// Prepares a refresh and adapts the reach to the number of calls that the last candidates served. False if
  /// the batch should do without a cache for now.
  bool begin_refresh(float least_reach_m, float most_reach_m);
  /// Stops caching for some calls because the candidates did not fit; the next attempt uses half the reach.
  void give_up() {
    count = 0;
    reach_m *= 0.5f;
    rest = kRest;
  }
};

/// Cached candidates of all batches of a set of particles, and the pose from which displacements count.
class CandidateCache {
 public:
  /// Batches lie in `memory` if it is not null.
  explicit CandidateCache(engine::MemoryResource* memory) : batches_(memory) {}

  /// Starts a call: adds the proxy's displacement since the last call. Allocates in the second call and when
  /// the number of particles grows. `beyond_m`: how much farther than the nearest an ellipsoid still counts.
  void begin_call(std::size_t particles, std::span<const geometry::Ellipsoid> shapes, float beyond_m);

  /// The cache of a batch; null in the first call. A cache costs as much as a query, and it pays only if
  /// there is another call.
  CachedBatch* batch(std::size_t i) { return batches_.empty() ? nullptr : &batches_[i]; }
  /// Sum of the proxy's displacements: an upper bound on that of any material point.
  double traveled_m() const { return traveled_m_; }

 private:
  void clear();

  engine::HostedArray<CachedBatch> batches_;
  bool first_call_ = true;
  std::vector<geometry::Ellipsoid> shapes_;
  float beyond_m_ = 0.0f;
  double traveled_m_ = 0.0;
};

}  // namespace bodice::collision
