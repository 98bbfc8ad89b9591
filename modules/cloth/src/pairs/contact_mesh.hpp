// The triangles of a garment in leaves, which are small connected patches, for self-contact. Each particle
// and each edge is owned by one of its triangles. So each pair of parts is found once, by the pair of
// triangles that own them.
// Based on: Sean Curtis, Rasmus Tamstorf, Dinesh Manocha. Fast Collision Detection for Deformable Models
// using Representative-Triangles. 2008.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <bodice/geometry/tri_mesh.hpp>

#include "base/particles.hpp"

namespace bodice::inline v0_1::cloth {

inline constexpr std::size_t kLeaf = 8;  ///< the most triangles in a leaf
inline constexpr std::size_t kNoBlock = ~std::size_t{0};

/// A triangle, and the particles and edges that it owns.
struct Face {
  Index particle[3] = {};
  std::uint8_t particles = 0;  ///< bit k: it owns particle k
  std::uint8_t edges = 0;      ///< bit k: it owns the edge from particle k to the next one
  bool turned = false;         ///< whether its winding is opposite to that of its patch
};

/// Leaves of triangles: first those inside blocks of particles (base/schedule.hpp), block by block, then
/// those across blocks; in each along a Morton curve.
struct ContactMesh {
  std::vector<Face> faces;                    ///< by leaf
  std::vector<std::uint32_t> face_begin;      ///< #leaves + 1: first triangle of each leaf
  std::vector<Index> particle;                ///< the particles of each leaf, each once, ascending
  std::vector<std::uint32_t> particle_begin;  ///< #leaves + 1
  std::vector<std::size_t> block;             ///< #leaves: its block of particles, or kNoBlock
  std::vector<std::uint32_t> star_begin;      ///< #P + 1, offsets into star
  std::vector<std::uint32_t> star;            ///< the triangles of each particle
  std::vector<std::uint32_t> leaf_of;         ///< #faces: the leaf of each triangle
  std::vector<bool> simple;                   ///< #P: whether its triangles are one fan
  std::size_t blocks = 0;

  std::size_t leaves() const { return block.size(); }
  std::span<const Face> faces_of(std::size_t leaf) const {
    return {faces.data() + face_begin[leaf], faces.data() + face_begin[leaf + 1]};
  }
  std::span<const Index> particles_of(std::size_t leaf) const {
    return {particle.data() + particle_begin[leaf], particle.data() + particle_begin[leaf + 1]};
  }
  std::span<const std::uint32_t> star_of(Index i) const {
    return {star.data() + star_begin[i], star.data() + star_begin[i + 1]};
  }
};

/// Divides the triangles of a welded garment into leaves. Precondition: its particles are in Morton order.
/// O(n log n).
ContactMesh make_contact_mesh(const geometry::TriMesh& mesh);

/// Whether two leaves are the same, or share a particle around which the surface is one patch.
bool are_joined(const ContactMesh& mesh, std::size_t leaf, std::size_t other);

}  // namespace bodice::cloth
