// The vertices next to each vertex of a mesh.
#pragma once

#include <span>
#include <vector>

#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::inline v0_1::geometry {

/// The neighbors of each vertex of a mesh, in compressed rows. Precondition: every index of a triangle is
/// below #V. O(#F).
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

}  // namespace bodice::geometry
