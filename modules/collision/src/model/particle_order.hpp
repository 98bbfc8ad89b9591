// A spatial order of particles, so that the kernels' speed does not depend on the order of the caller's
// arrays. It is kept in a workspace, or made anew for a few thousand particles at a time.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <bodice/collision/collider.hpp>

#include "model/batch.hpp"
#include "model/particle_view.hpp"

namespace bodice::inline v0_1::collision {

struct WorkspaceData;

/// A spatial order of one set of particles, refreshed when its blocks have spread.
class ParticleOrder {
 public:
  /// Arrays lie in `memory` if it is not null.
  explicit ParticleOrder(engine::MemoryResource* memory)
      : order_(memory), other_order_(memory), key_(memory), other_key_(memory), radius_m_(memory) {}

  /// Sorts again if the number of particles has changed or the blocks have spread since the last sort.
  void refresh(const ParticleView& particles);

  /// The order to visit particles in; empty if the order of the arrays is about as good.
  std::span<const std::uint32_t> order() const { return stored_ ? std::span<const std::uint32_t>() : order_; }

  /// Records a block's radius, meters; negative values are ignored. Only one thread may write a block.
  void note_radius(std::size_t block, float radius_m) {
    if (radius_m >= 0.0f) radius_m_[block] = radius_m;
  }

 private:
  engine::HostedArray<std::uint32_t> order_, other_order_;
  engine::HostedArray<std::uint32_t> key_, other_key_;
  engine::HostedArray<float> radius_m_;  // one a block
  bool stored_ = false;
  double spread_when_sorted_m_ = -1;  // sum of the radii; negative: not measured yet
};

/// Order to visit particles in along a Z-order curve if theirs is scattered, otherwise empty. It serves one
/// call of so many particles that a task's own order is too sparse.
std::vector<std::uint32_t> order_if_scattered(const ParticleView& particles);

/// The order of the particles of one task, sorted where that pays.
class TaskOrder {
 public:
  static constexpr std::size_t kMost = 32 * kBlock;  ///< tens of microseconds of work

  /// Orders the particles [begin, end), at most kMost.
  TaskOrder(const ParticleView& particles, std::size_t begin, std::size_t end);

  /// The order to visit particles in; empty: the order of the arrays.
  std::span<const std::uint32_t> order() const { return {order_, count_}; }

 private:
  std::uint32_t order_[kMost], other_order_[kMost];
  std::uint32_t key_[kMost], other_key_[kMost];
  std::size_t count_ = 0;
};

/// The order in which one task visits particles, and the workspace it belongs to.
struct ParticleSequence {
  std::span<const std::uint32_t>
      order;  ///< indices of the particles first, first + 1, ...; empty: the order of the arrays
  std::size_t first = 0;
  WorkspaceData* workspace = nullptr;  ///< may be null

  bool stored() const { return order.empty(); }
  std::size_t operator[](std::size_t i) const { return stored() ? i : order[i - first]; }
  /// Indices from the i-th on; null: the order of the arrays.
  const std::uint32_t* from(std::size_t i) const { return stored() ? nullptr : order.data() + (i - first); }
};

}  // namespace bodice::collision
