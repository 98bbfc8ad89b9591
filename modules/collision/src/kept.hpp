// Candidates kept from call to call: which ellipsoids can be the nearest of some neighbouring particles. A
// distance changes by no more than its place moves, and by no more than the ellipsoid's material does. Hence
// an ellipsoid that was farther than the nearest by more than twice the reach is not the nearest while place
// and material together have come no farther than the reach: answers among those that are kept have the same
// bits as among all.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <bodice/geometry/ellipsoid.hpp>

#include "kernels.hpp"

namespace bodice::collision {

/// What is kept about a batch.
struct alignas(64) KeptBatch {
  static constexpr int kSpan = 32, kSpans = kBatch / kSpan;  ///< lanes that share candidates
  static constexpr int kMost = 32;                           ///< candidates of all spans
  static constexpr int kLeastUse = 2;                        ///< calls that pay for finding what is kept
  static constexpr int kShortLife = 6, kLongLife = 40;       ///< calls: the reach grows or shrinks
  static constexpr int kRest = 16;                           ///< calls that nothing is kept after a failure

  float x[kBatch], y[kBatch], z[kBatch];  ///< metres: where the particles were
  float least_m[kSpans];                  ///< no place within reach is nearer to an ellipsoid
  std::uint32_t near[kSpans];             ///< a bit a candidate
  std::int32_t candidate[kMost];          ///< ellipsoids, rising
  int candidates = 0;
  int count = 0;  ///< lanes; zero: nothing is kept
  float reach_m = 0.0f;
  double travelled_m = 0.0;  ///< KeptCandidates::travelled_m() then
  int used = 0, rest = 0;    ///< calls

  /// Chooses the reach of what is found next; false if nothing should be kept now.
  bool renew(float least_reach_m, float most_reach_m);
  /// To be left alone for some calls.
  void give_up() {
    count = 0;
    rest = kRest;
  }
};

/// Of all batches of a set of particles, and the pose that the reaches count from.
class KeptCandidates {
 public:
  /// Before the batches of a call: takes note of how far the proxy moved since the last. Allocates when the
  /// particles become more. `beyond_m`: how much farther than the nearest an ellipsoid still counts.
  void begin(std::size_t particles, std::span<const geometry::Ellipsoid> shapes, float beyond_m);

  KeptBatch& batch(std::size_t i) { return batches_[i]; }
  /// The length of the proxy's way: no material of it moved farther since.
  double travelled_m() const { return travelled_m_; }

 private:
  void forget();

  std::vector<KeptBatch> batches_;
  std::vector<geometry::Ellipsoid> shapes_;
  float beyond_m_ = 0.0f;
  double travelled_m_ = 0.0;
};

}  // namespace bodice::collision
