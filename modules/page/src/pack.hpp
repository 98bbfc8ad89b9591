// Arrays as text in a page.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <bodice/engine/base64.hpp>
#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::inline v0_1::page {

template <class T>
std::string packed(const std::vector<T>& values) {
  return engine::base64(std::as_bytes(std::span<const T>(values)));
}

/// Positions in a cube, 16 bits a coordinate.
struct Cube {
  geometry::Vec3 low = geometry::Vec3::Zero();
  double size_m = 1.0;
};
Cube cube_around(std::span<const geometry::Vec3> points, const Cube* with = nullptr);
std::string packed_positions(std::span<const geometry::Vec3> points, const Cube& cube);
/// Colors with one byte a channel.
std::string packed_colors(std::span<const std::array<float, 3>> colors);
std::string packed_triangles(std::span<const geometry::Triangle> triangles);

/// A mesh with one vertex for each cell of a lattice, and the original vertex of each.
struct ThinMesh {
  std::vector<geometry::Index> vertex;        ///< #thin, into the mesh's vertices
  std::vector<geometry::Triangle> triangles;  ///< corners are indices of thinned vertices
};
/// The mesh itself if it has at most so many vertices; else cells grow until few enough are left.
ThinMesh thinned(const geometry::TriMesh& mesh, std::size_t most);

}  // namespace bodice::page
