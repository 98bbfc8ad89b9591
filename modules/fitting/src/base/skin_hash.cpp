#include "base/skin_hash.hpp"

#include <bodice/engine/hash.hpp>

namespace bodice::inline v0_1::fitting {

std::uint64_t skin_hash(const geometry::TriMesh& mesh) {
  engine::Hasher hasher;
  for (const geometry::Vec3& p : mesh.positions)
    for (int j = 0; j < 3; ++j) hasher.add(p[j]);
  for (const geometry::Triangle& t : mesh.triangles)
    for (const geometry::Index v : t) hasher.add(v);
  return hasher.value();
}

}  // namespace bodice::fitting
