// Candidates kept from call to call: which ellipsoids can be the nearest of some neighboring particles. A
// distance changes by no more than its place moves, and by no more than the ellipsoid's material does. Hence
// an ellipsoid that was farther than the nearest by some slack is not the nearest while place and material
// together have come less far than half of that: answers among the others have the same bits as among all.
// Kept is what has less slack than twice the reach (and relief's blending); asked is what has less than twice
// the way so far, which is little at first.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <bodice/geometry/ellipsoid.hpp>

#include "model/batch.hpp"

namespace bodice::collision {

/// What is kept about a batch.
struct alignas(64) CachedBatch {
  static constexpr int kSpan = 32, kSpans = kBatch / kSpan;  ///< lanes that share candidates
  static constexpr int kCapacity = 32;                       ///< candidates of all spans
  static constexpr int kLeastUse = 2;                        ///< calls that pay for finding what is kept
  static constexpr int kShortLife = 6, kLongLife = 40;       ///< calls: the reach grows or shrinks
  static constexpr int kRest = 16;                           ///< calls that nothing is kept after a failure
  static constexpr float kFar_m = 1e30f;                     ///< meters

  float x[kBatch], y[kBatch], z[kBatch];  ///< meters: where the particles were
  float least_m[kSpans];                  ///< no place was nearer to an ellipsoid
  /// By how much a candidate was farther than the nearest, at least; kFar_m: it is not near the span.
  alignas(64) float slack_m[kSpans][kCapacity];
  std::int32_t candidate[kCapacity];  ///< ellipsoids, rising
  int candidates = 0;
  int count = 0;  ///< lanes; zero: nothing is kept
  float reach_m = 0.0f;
  float moved_m = 0.0f;     ///< how far place and material have come together, at most
  double traveled_m = 0.0;  ///< CandidateCache::traveled_m() then
  int used = 0, rest = 0;   ///< calls

  /// Chooses the reach of what is found next; false if nothing should be kept now.
  bool begin_refresh(float least_reach_m, float most_reach_m);
  /// What was found does not fit: to be left alone for some calls, then tried with less.
  void give_up() {
    count = 0;
    reach_m *= 0.5f;
    rest = kRest;
  }
};

/// Of all batches of a set of particles, and the pose that the reaches count from.
class CandidateCache {
 public:
  /// Before the batches of a call: takes note of how far the proxy moved since the last. Allocates when the
  /// particles become more. `beyond_m`: how much farther than the nearest an ellipsoid still counts.
  void begin_call(std::size_t particles, std::span<const geometry::Ellipsoid> shapes, float beyond_m);

  CachedBatch& batch(std::size_t i) { return batches_[i]; }
  /// The length of the proxy's way: no material of it moved farther since.
  double traveled_m() const { return traveled_m_; }

 private:
  void clear();

  std::vector<CachedBatch> batches_;
  std::vector<geometry::Ellipsoid> shapes_;
  float beyond_m_ = 0.0f;
  double traveled_m_ = 0.0;
};

}  // namespace bodice::collision
