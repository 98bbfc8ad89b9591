// State of the particles that are pushed out: all that may be below the clearance, and those of a round,
// closed up.
#if defined(BODICE_COLLISION_PUSH_STATE_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_PUSH_STATE_INL_
#undef BODICE_COLLISION_PUSH_STATE_INL_
#else
#define BODICE_COLLISION_PUSH_STATE_INL_
#endif

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "model/batch.hpp"
#include "simd/math/pack-inl.hpp"
#include "simd/math/planes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::inline v0_1::collision::HWY_NAMESPACE {

/// A plane of each particle: the half-space beyond it is clear of an ellipsoid.
struct alignas(64) PlaneRows {
  float nx[kBatch], ny[kBatch], nz[kBatch], offset[kBatch];
  std::int32_t ellipsoid[kBatch];  ///< internal index; -1: not active, and the other numbers are not read

  HWY_INLINE V3 normal(int i) const { return load3(nx + i, ny + i, nz + i); }
  HWY_INLINE Plane at(int i) const { return {normal(i), hn::Load(f, offset + i)}; }
  HWY_INLINE Plane gather(VI at) const { return {gather3(nx, ny, nz, at), hn::GatherIndex(f, offset, at)}; }
  HWY_INLINE V3 gather_normal(VI at) const { return gather3(nx, ny, nz, at); }
  HWY_INLINE VI ellipsoids(VI at) const { return hn::GatherIndex(I(), ellipsoid, at); }
  HWY_INLINE M active(int i) const {
    return hn::RebindMask(f, hn::Gt(hn::Load(I(), ellipsoid + i), hn::Set(I(), -1)));
  }
  HWY_INLINE void deactivate() { std::memset(ellipsoid, 0xFF, sizeof(ellipsoid)); }
};

/// One array a number for the particles of InRange.
struct alignas(64) PushState {
  float x[kBatch], y[kBatch], z[kBatch];  ///< current position
  PlaneRows plane[3];                     ///< active planes; the first is that of the owner at the start
  LaneBits open;                          ///< still below the clearance after the last round
  std::uint32_t rounds = 0;
};

struct LanesBelow;

/// Target of a push and the plain ellipsoids that it clears for certain; -1: none.
struct Push {
  V3 to;
  VI clear1, clear2, clear3;
};

/// The particles that were pushed in a round, closed up.
struct alignas(64) PushedLanes {
  static constexpr int kSize = kBatch + 16;
  float x[kSize], y[kSize], z[kSize];
  std::int32_t clear1[kSize], clear2[kSize], clear3[kSize];  ///< as in Push
  std::int32_t lane[kSize];                                  ///< index in PushState
  int count = 0;

  /// Adds particles after their first push, out of the ellipsoids `owner`.
  HWY_INLINE void add(M which, VI lanes, V3 p, VI owner) {
    const Pack pack(which);
    pack.store(p.x, x + count);
    pack.store(p.y, y + count);
    pack.store(p.z, z + count);
    pack.store(owner, clear1 + count);
    pack.store(lanes, lane + count);
    count += pack.count();
  }
  /// Ends a series of add().
  HWY_INLINE void close() {
    std::memset(clear2, 0xFF, sizeof(clear2));
    std::memset(clear3, 0xFF, sizeof(clear3));
    pad();
  }
  /// Overwrites lanes [i, i + kWidth) by particles that are pushed once more.
  HWY_INLINE void put(const Push& push, int i) {
    store3(push.to, x + i, y + i, z + i);
    hn::Store(push.clear1, I(), clear1 + i);
    hn::Store(push.clear2, I(), clear2 + i);
    hn::Store(push.clear3, I(), clear3 + i);
  }
  /// Ends a series of put().
  HWY_INLINE void close(const LanesBelow& below);

 private:
  /// Repeats the last particle until the block is full.
  HWY_INLINE void pad() {
    if (count == 0) return;
    const int end = (count + kBlock - 1) / kBlock * kBlock;
    for (float* values : {x, y, z}) std::fill(values + count, values + end, values[count - 1]);
    for (std::int32_t* values : {clear1, clear2, clear3})
      std::fill(values + count, values + end, values[count - 1]);
  }
};

/// Lanes of PushedLanes that are still below the clearance, closed up: their index there, and in PushState.
struct alignas(64) LanesBelow {
  std::int32_t at[kBatch + 16], lane[kBatch + 16];
  int count = 0;

  HWY_INLINE LanesBelow(const float* distance, float limit_m, const PushedLanes& pushed) {
    for (int i = 0; i < pushed.count; i += kWidth) {
      const M below = hn::And(lanes_below(i, pushed.count), hn::Lt(hn::Load(f, distance + i), all(limit_m)));
      const Pack pack(below);
      pack.store(lanes_from(i), at + count);
      pack.store(hn::Load(I(), pushed.lane + i), lane + count);
      count += pack.count();
    }
  }
};

HWY_INLINE void PushedLanes::close(const LanesBelow& below) {
  count = below.count;
  std::copy_n(below.lane, below.count, lane);
  pad();
}

/// Stores the lanes of a mask at an index each.
class Scatter {
 public:
  HWY_INLINE Scatter(M which, VI at) : pack_(which) { pack_.store(at, at_); }
  HWY_INLINE void store(V value, float* to) const { store_as(value, to); }
  HWY_INLINE void store(VI value, std::int32_t* to) const { store_as(value, to); }
  HWY_INLINE void store(V3 value, float* x, float* y, float* z) const {
    store(value.x, x);
    store(value.y, y);
    store(value.z, z);
  }
  HWY_INLINE void store(const Plane& plane, VI ellipsoids, PlaneRows& to) const {
    store(plane.n, to.nx, to.ny, to.nz);
    store(plane.offset, to.offset);
    store(ellipsoids, to.ellipsoid);
  }

 private:
  template <class Vector, class T>
  HWY_INLINE void store_as(Vector value, T* to) const {
    alignas(64) T values[kWidth];
    pack_.store(value, values);
    for (int i = 0; i < pack_.count(); ++i) to[at_[i]] = values[i];
  }

  Pack pack_;
  alignas(64) std::int32_t at_[kWidth];
};

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
