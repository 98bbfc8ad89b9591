// What the float kernels read and write: a batch of neighboring particles a call.
#pragma once

#include <cstdint>
#include <limits>

#include <bodice/collision/collider.hpp>

#include "model/surface_motion.hpp"

namespace bodice::collision {

inline constexpr int kBlock = 64;  ///< particles a block: culling costs about as much as two of them

/// Particles the kernels work on at a time: their blocks share candidates, and what first answers leave open
/// shares vectors.
inline constexpr int kBatch = 256;

/// Ellipsoids near a block; where more are, the exact side works.
inline constexpr int kMaxCandidates = 256;

struct CachedBatch;

/// What is kept about a batch from call to call.
struct CacheAccess {
  CachedBatch* batch = nullptr;  ///< null: nothing
  double traveled_m = 0.0;       ///< length of the proxy's way
  float least_reach_m = 0.0f, most_reach_m = 0.0f;
};

/// What the next batch will read and write, so that it is in the cache by then.
struct NextBatch {
  const float *x = nullptr, *y = nullptr, *z = nullptr;  ///< of places that lie in a row; else null
  Contact* contacts = nullptr;                           ///< null: none are written
  const std::uint32_t* index = nullptr;                  ///< into contacts; null: in a row as well
  int count = 0;
  const CachedBatch* cached = nullptr;
};

/// What a query reads and writes.
struct QueryBatch {
  const float *x, *y, *z;      ///< meters, local frame; repeated up to a whole block
  const std::uint32_t* index;  ///< into contacts, a particle; null: in order
  int count;                   ///< at most kBatch
  float margin_m;
  float within_m;  ///< particles farther from the surface are told nothing
  Accuracy accuracy = Accuracy::kExact;
  Contact* contacts;                ///< of the whole call
  float radius_m[kBatch / kBlock];  ///< out, a block: half its box's diagonal; below zero: not measured
  CacheAccess cache = {};
  NextBatch next_batch = {};

  bool limited() const { return within_m != std::numeric_limits<float>::infinity(); }
};

/// What is told about a particle that is not finite, or is farther than was asked for.
inline Contact no_contact() {
  Contact contact;
  contact.signed_distance = std::numeric_limits<float>::infinity();
  contact.ellipsoid = kNoEllipsoid;
  return contact;
}

/// Particles of some blocks, gathered; up to a whole block lanes beyond `count` repeat the last one.
struct alignas(64) ParticleBatch {
  float x[kBatch], y[kBatch], z[kBatch];     ///< meters, local frame
  float vx[kBatch], vy[kBatch], vz[kBatch];  ///< meters a second, if has_velocity
  float sx[kBatch], sy[kBatch], sz[kBatch];  ///< meters, last safe positions, if has_safe
  int count = 0;
  bool has_velocity = false;
  bool has_safe = false;
  CacheAccess cache = {};
  NextBatch next_batch = {};
};

/// What a response asks of the kernel.
struct ResponseParameters {
  float clearance_m;  ///< margin + thickness: where the particles are put
  float slack_m;      ///< how far beyond, so that rounding does not put them below
  float friction;
  float max_push_m;
  const SurfaceMotion* motion;  ///< an ellipsoid; null: the body rests
  float dt_s = 0.0f;            ///< that the motion took
  float travel_m = 0.0f;        ///< that no place of the body moved farther than
  float blend_m = 0.0f;         ///< of the smooth union; zero: creases stay sharp
};

/// A bit a lane.
struct LaneBits {
  static_assert(kBlock == 64);
  std::uint64_t word[kBatch / kBlock] = {};

  bool none() const { return (word[0] | word[1] | word[2] | word[3]) == 0; }
  /// Lanes [lane, lane + 64 - lane % 64).
  std::uint64_t from(int lane) const { return word[lane / kBlock] >> lane % kBlock; }
  void add(std::uint64_t bits, int lane) { word[lane / kBlock] |= bits << lane % kBlock; }
  void set(int lane, bool to) {
    const std::uint64_t bit = std::uint64_t{1} << lane % kBlock;
    word[lane / kBlock] = to ? word[lane / kBlock] | bit : word[lane / kBlock] & ~bit;
  }
};

/// What a response makes of a batch.
struct alignas(64) BatchResponse {
  static constexpr int kSize = kBatch + 16;  ///< whole vectors are written
  /// Particles that were below the clearance, and where they are now: `count` of them, by rising lane.
  std::int32_t lane[kSize];
  std::int32_t owner[kSize];              ///< the deepest ellipsoid
  float x[kSize], y[kSize], z[kSize];     ///< meters, local frame
  float vx[kSize], vy[kSize], vz[kSize];  ///< meters a second, if has_velocity
  int count = 0;
  int pending = 0;               ///< of those: held back by max_push_m
  LaneBits left_to_exact;        ///< not settled and not among them: for the exact side
  std::uint32_t iterations = 0;  ///< most pushes
  float deepest_m = 0.0f;        ///< below the clearance before the response
  /// A block: half its box's diagonal; below zero: not measured.
  float radius_m[kBatch / kBlock] = {-1.0f, -1.0f, -1.0f, -1.0f};
};

}  // namespace bodice::collision
