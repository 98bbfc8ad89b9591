// A spatial order of particles: what makes the kernels' speed independent of the order in which the caller
// stores them. Kept from call to call, or made anew for some thousand particles at a time.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <bodice/collision/collider.hpp>

#include "model/batch.hpp"

namespace bodice::collision {

struct WorkspaceData;

class ParticleOrder {
 public:
  /// Sorts again if the number has changed or the blocks have come apart since the last sort.
  void refresh(const Particles& particles);

  /// Empty: as they are stored, which is about as good.
  std::span<const std::uint32_t> order() const { return stored_ ? std::span<const std::uint32_t>() : order_; }

  /// Written by whoever works on a block: the block's radius, meters, unless below zero. One writer a block.
  void note_radius(std::size_t block, float radius_m) {
    if (radius_m >= 0.0f) radius_m_[block] = radius_m;
  }

 private:
  std::vector<std::uint32_t> order_, other_order_;
  std::vector<std::uint32_t> key_, other_key_;
  std::vector<float> radius_m_;  // a block
  bool stored_ = false;
  double spread_when_sorted_m_ = -1;  // sum of the radii; negative: not measured yet
};

/// The particles of one task, in an order of their own where that pays.
class TaskOrder {
 public:
  static constexpr std::size_t kMost = 32 * kBlock;  ///< particles a task: some tens of microseconds

  /// Particles [begin, end), at most kMost.
  TaskOrder(const Particles& particles, std::size_t begin, std::size_t end);

  /// Empty: as they are stored.
  std::span<const std::uint32_t> order() const { return {order_, count_}; }

 private:
  std::uint32_t order_[kMost], other_order_[kMost];
  std::uint32_t key_[kMost], other_key_[kMost];
  std::size_t count_ = 0;
};

/// In which order particles are worked on.
struct ParticleSequence {
  std::span<const std::uint32_t> order;  ///< of particles first, first + 1, ...; empty: as they are stored
  std::size_t first = 0;
  WorkspaceData* workspace = nullptr;  ///< of the set of particles, or null

  bool stored() const { return order.empty(); }
  std::size_t operator[](std::size_t i) const { return stored() ? i : order[i - first]; }
  /// From the i-th on.
  const std::uint32_t* from(std::size_t i) const { return stored() ? nullptr : order.data() + (i - first); }
};

}  // namespace bodice::collision
