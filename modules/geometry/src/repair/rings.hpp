// The vertices around a vertex, ring by ring.
#pragma once

#include <span>
#include <vector>

#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::inline v0_1::geometry {

/// The neighbors of each vertex of a mesh, in compressed rows.
class Neighbors {
 public:
  explicit Neighbors(const TriMesh& mesh);
  std::size_t vertices() const { return offset_.size() - 1; }
  std::span<const Index> of(std::size_t vertex) const {
    return {all_.data() + offset_[vertex], offset_[vertex + 1] - offset_[vertex]};
  }

 private:
  std::vector<std::size_t> offset_;  ///< #V + 1
  std::vector<Index> all_;           ///< ascending within a vertex
};

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

}  // namespace bodice::geometry
