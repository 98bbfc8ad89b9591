// The garment's particles as structure of arrays. They are in a local frame, so that floats resolve
// micrometers anywhere.
#pragma once

#include <vector>

#include <bodice/geometry/tri_mesh.hpp>

#include "base/float4.hpp"

namespace bodice::inline v0_1::cloth {

using geometry::Index;
using geometry::Mat3;
using geometry::Triangle;
using geometry::Vec3;

/// A pinned particle counts for a coarse node with its mass times this factor.
inline constexpr float kPinnedMass = 1e3f;

/// Arrays of #P, up to the next multiple of four. A world position is origin + (x, y, z). While constraints
/// are solved, `point` has the positions; x, y, z have them before and after.
struct Particles {
  std::size_t size = 0;
  Vec3 origin = Vec3::Zero();
  std::vector<float> x, y, z;              ///< meters
  std::vector<float> old_x, old_y, old_z;  ///< meters, at the start of the substep
  std::vector<float> vx, vy, vz;           ///< meters a second
  std::vector<float> mass;                 ///< kilograms, also of pinned particles
  std::vector<float> inverse_mass;         ///< 0: the particle is pinned
  std::vector<Point> point;                ///< #P, then those for idle slots of a schedule, then three more

  std::size_t count() const { return size; }
  Vec3 world(std::size_t i) const {
    return origin + Vec3(static_cast<double>(x[i]), static_cast<double>(y[i]), static_cast<double>(z[i]));
  }
};

/// The order by Morton code of the rest position, ties by index: result[new] = old. Neighbors in space are
/// near each other in memory, so that collision rules out blocks of particles and constraints find particles
/// in the cache.
std::vector<Index> morton_order(const std::vector<Vec3>& positions);

/// Particles at rest at the mesh's positions. Each has a third of the mass of its triangles, but not less
/// than a floor.
Particles make_particles(const geometry::TriMesh& mesh, double density_kg_m2,
                         const std::vector<bool>& pinned);

/// Moves the local frame. World positions stay the same, up to the rounding of floats.
void rebase(Particles& particles, const Vec3& origin);

}  // namespace bodice::cloth
