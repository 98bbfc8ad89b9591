// A spatial order of particles that is kept from call to call: what makes the kernels' speed independent of
// the order in which the caller stores them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <bodice/collision/collider.hpp>

namespace bodice::collision {

class ParticleOrder {
 public:
  /// Sorts again if the number has changed or the blocks have come apart since the last sort.
  void refresh(const Particles& particles);

  std::span<const std::uint32_t> order() const { return order_; }

  /// Written by whoever works on a block: the block's radius, metres. One writer a block.
  void note_radius(std::size_t block, float radius_m) { radius_m_[block] = radius_m; }

 private:
  void sort(const Particles& particles);

  std::vector<std::uint32_t> order_, other_order_;
  std::vector<std::uint32_t> key_, other_key_;
  std::vector<float> radius_m_;       // a block
  double spread_when_sorted_m_ = -1;  // sum of the radii; negative: not measured yet
};

}  // namespace bodice::collision
