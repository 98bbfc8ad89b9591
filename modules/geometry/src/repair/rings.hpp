// The vertices around a vertex, ring by ring.
#pragma once

#include <span>
#include <vector>

#include <bodice/engine/parallel.hpp>
#include <bodice/geometry/neighbors.hpp>

namespace bodice::inline v0_1::geometry {

/// Rings of neighbors around one vertex after another, in memory that is kept.
class Rings {
 public:
  explicit Rings(const Neighbors& neighbors) : neighbors_(neighbors), seen_(neighbors.vertices(), 0) {}

  /// Begins anew with the ring that is the vertex itself.
  void begin(Index vertex);
  /// Adds a ring of the neighbors of the last one and returns it; empty where there are no more.
  std::span<const Index> grow();
  /// All vertices so far, ring after ring.
  std::span<const Index> all() const { return found_; }

 private:
  const Neighbors& neighbors_;
  std::vector<std::uint32_t> seen_;  ///< #V: the number of the last vertex that was begun with and has it
  std::uint32_t turn_ = 0;
  std::vector<Index> found_;
  std::size_t last_ = 0;  ///< where the last ring begins
};

/// Calls visit(vertex, rings) for each vertex, on all workers.
template <class Visit>
void for_each_with_rings(const engine::Context& context, const Neighbors& neighbors, const Visit& visit) {
  constexpr std::size_t kBlocks = 32;  // each has memory for all vertices
  const std::size_t count = neighbors.vertices();
  engine::parallel_for(context, count, count / kBlocks + 1, [&](std::size_t begin, std::size_t end) {
    Rings rings(neighbors);
    for (std::size_t v = begin; v < end; ++v) visit(static_cast<Index>(v), rings);
  });
}

}  // namespace bodice::geometry
