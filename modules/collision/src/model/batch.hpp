// What the float kernels read and write: one batch of neighboring particles a call.
#pragma once

#include <cstdint>
#include <limits>

#include <bodice/collision/collider.hpp>

#include "model/surface_motion.hpp"

namespace bodice::inline v0_1::collision {

inline constexpr int kBlock = 64;  ///< particles a block; its broad phase costs about as much as two of them

/// Particles that one call of a kernel handles. Their blocks share candidates, and the pairs that the first
/// evaluation leaves open fill vectors together.
inline constexpr int kBatch = 256;

/// Largest number of candidates of a block; with more, a fallback is taken.
inline constexpr int kMaxCandidates = 256;

struct CachedBatch;

/// Access to the candidate cache of one batch.
struct CacheAccess {
  CachedBatch* batch = nullptr;  ///< null: no cache
  double traveled_m = 0.0;       ///< CandidateCache::traveled_m()
  float least_reach_m = 0.0f, most_reach_m = 0.0f;
};

/// What the next batch will read and write, so that it can be prefetched.
struct NextBatch {
  const float *x = nullptr, *y = nullptr, *z = nullptr;  ///< null unless its particles are consecutive
  Contact* contacts = nullptr;                           ///< null: not to be prefetched
  const std::uint32_t* index = nullptr;  ///< into contacts; null: they are consecutive as well
  int count = 0;
  const CachedBatch* cached = nullptr;
};

/// Positions of at most kBatch particles; the last one is repeated to fill a block. Meters, local frame.
struct Positions {
  const float *x = nullptr, *y = nullptr, *z = nullptr;
  int count = 0;
};

/// Particles that are evaluated together.
struct Batch {
  Positions at;
  CacheAccess cache = {};
  NextBatch next = {};
  float radius_m[kBatch / kBlock] =
      {};  ///< out, one a block: half the diagonal of its box; negative: unknown
};

/// Receives the contacts of a batch.
struct ContactOutput {
  Contact* contacts = nullptr;           ///< those of the whole call
  const std::uint32_t* index = nullptr;  ///< into contacts, one a particle; null: in order
  float margin_m = 0.0f;
  float within_m = std::numeric_limits<float>::infinity();  ///< particles beyond it get no_contact()

  Contact& of(int lane) const { return contacts[index ? index[lane] : static_cast<std::uint32_t>(lane)]; }
  bool limited() const { return within_m != std::numeric_limits<float>::infinity(); }
};

/// The contact of a particle that is not finite or is beyond the contact distance.
inline Contact no_contact() {
  Contact contact;
  contact.signed_distance = std::numeric_limits<float>::infinity();
  contact.ellipsoid = kNoEllipsoid;
  return contact;
}

/// Positions, velocities and safe positions of some blocks. Lanes beyond `count` repeat the last particle
/// until the block is full.
struct alignas(64) ParticleBatch {
  float x[kBatch], y[kBatch], z[kBatch];     ///< meters, local frame
  float vx[kBatch], vy[kBatch], vz[kBatch];  ///< meters a second, if has_velocity
  float sx[kBatch], sy[kBatch], sz[kBatch];  ///< meters, safe positions, if has_safe
  int count = 0;
  bool has_velocity = false;
  bool has_safe = false;
  CacheAccess cache = {};
  NextBatch next = {};
};

/// Settings of a response as the kernel needs them.
struct ResponseParameters {
  float clearance_m;  ///< margin + thickness: distance at which particles are put
  float slack_m;      ///< overshoot that keeps rounding from putting them below the clearance
  float friction;
  float max_push_m;
  const SurfaceMotion* motion;  ///< one an ellipsoid; null: the body rests
  float dt_s = 0.0f;            ///< duration of the last move, seconds
  float travel_m = 0.0f;        ///< bound on the displacement of any point of the body in the last move
  float blend_m = 0.0f;         ///< blend radius of the smooth union; zero: creases stay sharp
};

/// A set of lanes of a batch, one bit each.
struct LaneBits {
  static_assert(kBlock == 64);
  std::uint64_t word[kBatch / kBlock] = {};

  bool none() const { return (word[0] | word[1] | word[2] | word[3]) == 0; }
  /// Bits of the lanes [lane, lane + 64 - lane % 64).
  std::uint64_t from(int lane) const { return word[lane / kBlock] >> lane % kBlock; }
  void add(std::uint64_t bits, int lane) { word[lane / kBlock] |= bits << lane % kBlock; }
  void set(int lane, bool to) {
    const std::uint64_t bit = std::uint64_t{1} << lane % kBlock;
    word[lane / kBlock] = to ? word[lane / kBlock] | bit : word[lane / kBlock] & ~bit;
  }
};

/// Result of a response for one batch.
struct alignas(64) BatchResponse {
  static constexpr int kSize = kBatch + 16;  ///< room for whole vectors
  /// The particles that were below the clearance and their new positions, `count` of them by rising lane.
  std::int32_t lane[kSize];
  std::int32_t owner[kSize];              ///< the ellipsoid that each was deepest in
  float x[kSize], y[kSize], z[kSize];     ///< meters, local frame
  float vx[kSize], vy[kSize], vz[kSize];  ///< meters a second, if has_velocity
  int count = 0;
  int pending = 0;               ///< how many of these max_push_m held back
  LaneBits left_to_exact;        ///< particles that the kernel could not settle; they are not among these
  std::uint32_t iterations = 0;  ///< largest number of pushes of a particle
  float deepest_m = 0.0f;        ///< largest depth below the clearance before the response
  /// Half the diagonal of each block's box; negative: not measured.
  float radius_m[kBatch / kBlock] = {-1.0f, -1.0f, -1.0f, -1.0f};
};

}  // namespace bodice::collision
