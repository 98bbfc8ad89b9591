#include "import/scene/file_scene.hpp"

#include <bit>
#include <unordered_map>

#include <bodice/engine/random.hpp>

namespace bodice::inline v0_1::io {

namespace {

using geometry::Index;
using geometry::Vec3;
using Key = std::array<std::uint64_t, 3>;

Key key_of(const Vec3& p) {
  Key key;
  for (int k = 0; k < 3; ++k) key[static_cast<std::size_t>(k)] = std::bit_cast<std::uint64_t>(p[k] + 0.0);
  return key;
}

struct KeyHash {
  std::size_t operator()(const Key& key) const {
    return engine::mix64(key[0] ^ engine::mix64(key[1] ^ engine::mix64(key[2])));
  }
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
  std::vector<Index> first;                       // first use of each shared vertex
  std::unordered_map<Key, Index, KeyHash> found;  // used for lookup only, so that its order does not matter
  found.reserve(mesh.positions.size() / 4);
  shared.triangles.reserve(mesh.triangles.size());
  for (const geometry::Triangle& triangle : mesh.triangles) {
    geometry::Triangle& out = shared.triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& p = mesh.positions[triangle[k]];
      const auto [at, fresh] = found.try_emplace(key_of(p), static_cast<Index>(shared.positions.size()));
      if (fresh) {
        shared.positions.push_back(p);
        first.push_back(triangle[k]);
      }
      out[k] = at->second;
    }
  }
  file_mesh.weights = take_weights(file_mesh.weights, first);
  file_mesh.shape = std::move(shared);
}

}  // namespace bodice::io
