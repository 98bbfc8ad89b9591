#include "import/scene/file_scene.hpp"

#include <bit>
#include <utility>

#include <bodice/engine/random.hpp>

namespace bodice::inline v0_1::io {

namespace {

using geometry::Index;
using geometry::kNoIndex;
using geometry::Vec3;
using Key = std::array<std::uint64_t, 3>;

Key key_of(const Vec3& p) {
  Key key;
  for (int k = 0; k < 3; ++k) key[static_cast<std::size_t>(k)] = std::bit_cast<std::uint64_t>(p[k] + 0.0);
  return key;
}

std::size_t hash_of(const Key& key) {
  return engine::mix64(key[0] ^ engine::mix64(key[1] ^ engine::mix64(key[2])));
}

/// Positions without repetitions of the same bits, found in a table that is at most half full.
class SharedPositions {
 public:
  SharedPositions() : slot_(std::size_t{1} << 10, kNoIndex) {}

  /// The number of a position, and whether it is new.
  std::pair<Index, bool> add(const Vec3& p) {
    const Key key = key_of(p);
    std::size_t at = find(key);
    if (slot_[at] != kNoIndex) return {slot_[at], false};
    if (2 * positions_.size() >= slot_.size()) {
      grow();
      at = find(key);
    }
    slot_[at] = static_cast<Index>(positions_.size());
    positions_.push_back(p);
    return {slot_[at], true};
  }

  std::vector<Vec3> take() { return std::move(positions_); }

 private:
  /// The slot that has the key, else the free one where it belongs.
  std::size_t find(const Key& key) const {
    std::size_t at = hash_of(key) & (slot_.size() - 1);
    while (slot_[at] != kNoIndex && key_of(positions_[slot_[at]]) != key) at = (at + 1) & (slot_.size() - 1);
    return at;
  }

  void grow() {
    slot_.assign(4 * slot_.size(), kNoIndex);
    for (Index i = 0; i < positions_.size(); ++i) slot_[find(key_of(positions_[i]))] = i;
  }

  std::vector<Vec3> positions_;
  std::vector<Index> slot_;
};

}  // namespace

void append(const geometry::TriMesh& mesh, geometry::TriMesh& to) {
  const Index first = static_cast<Index>(to.positions.size());
  to.positions.insert(to.positions.end(), mesh.positions.begin(), mesh.positions.end());
  to.triangles.reserve(to.triangles.size() + mesh.triangles.size());
  for (const geometry::Triangle& t : mesh.triangles)
    to.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
}

void share_vertices(FileMesh& file_mesh) {
  const geometry::TriMesh& mesh = file_mesh.shape;
  geometry::TriMesh shared;
  SharedPositions positions;
  std::vector<Index> first;                                // first use of each shared vertex
  std::vector<Index> to(mesh.positions.size(), kNoIndex);  // the shared vertex of each
  shared.triangles.reserve(mesh.triangles.size());
  for (const geometry::Triangle& triangle : mesh.triangles) {
    geometry::Triangle& out = shared.triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const Index v = triangle[k];
      if (to[v] == kNoIndex) {
        const auto [number, fresh] = positions.add(mesh.positions[v]);
        if (fresh) first.push_back(v);
        to[v] = number;
      }
      out[k] = to[v];
    }
  }
  shared.positions = positions.take();
  file_mesh.weights = take_weights(file_mesh.weights, first);
  file_mesh.shape = std::move(shared);
}

}  // namespace bodice::io
