#include "unit_sphere.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace bodice::inline v0_1::io {

namespace {

using geometry::Index;
using geometry::Vec3;

geometry::TriMesh octahedron() {
  geometry::TriMesh mesh;
  mesh.positions = {Vec3::UnitX(),  -Vec3::UnitX(), Vec3::UnitY(),
                    -Vec3::UnitY(), Vec3::UnitZ(),  -Vec3::UnitZ()};
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  return mesh;
}

geometry::TriMesh split(const geometry::TriMesh& mesh) {
  geometry::TriMesh finer;
  finer.positions = mesh.positions;
  std::map<std::pair<Index, Index>, Index> middle_of;
  auto middle = [&](Index a, Index b) {
    const auto [at, fresh] =
        middle_of.try_emplace(std::minmax(a, b), static_cast<Index>(finer.positions.size()));
    if (fresh) finer.positions.push_back((mesh.positions[a] + mesh.positions[b]).normalized());
    return at->second;
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    const Index ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    finer.triangles.insert(finer.triangles.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
  return finer;
}

}  // namespace

geometry::TriMesh unit_sphere(int splits) {
  geometry::TriMesh mesh = octahedron();
  for (int i = 0; i < splits; ++i) mesh = split(mesh);
  return mesh;
}

}  // namespace bodice::io
