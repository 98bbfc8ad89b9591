// Surfaces on which distances have a closed form.
#pragma once

#include <cmath>
#include <map>

#include <bodice/geometry/tri_mesh.hpp>

namespace shapes {

using bodice::geometry::Index;
using bodice::geometry::TriMesh;
using bodice::geometry::Vec3;

/// A grid of (n + 1)^2 vertices in the plane z = 0 over [0, size]^2, with one diagonal a square.
inline TriMesh grid(int n, double size = 1.0) {
  TriMesh mesh;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) mesh.positions.emplace_back(size * i / n, size * j / n, 0.0);
  const auto at = [&](int i, int j) { return static_cast<Index>(j * (n + 1) + i); };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return mesh;
}

/// An octahedron, refined `levels` times, on the sphere of `radius` about `center`. Vertex 0 is at +z.
inline TriMesh sphere(int levels, double radius = 1.0, const Vec3& center = Vec3::Zero()) {
  TriMesh mesh;
  mesh.positions = {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}, {5, 2, 1}, {5, 3, 2}, {5, 4, 3}, {5, 1, 4}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<Index, Index>, Index> middle;
    const auto half = [&](Index a, Index b) {
      const auto [it, fresh] =
          middle.try_emplace(std::minmax(a, b), static_cast<Index>(mesh.positions.size()));
      if (fresh) mesh.positions.push_back((mesh.positions[a] + mesh.positions[b]).normalized());
      return it->second;
    };
    std::vector<bodice::geometry::Triangle> finer;
    for (const auto& [a, b, c] : mesh.triangles) {
      const Index ab = half(a, b), bc = half(b, c), ca = half(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    mesh.triangles = std::move(finer);
  }
  for (Vec3& p : mesh.positions) p = center + radius * p;
  return mesh;
}

}  // namespace shapes
