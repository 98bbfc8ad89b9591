// The garment's particles as structure of arrays, in a local frame, so that floats keep micrometers anywhere.
#pragma once

#include <vector>

#include <bodice/geometry/tri_mesh.hpp>

#include "base/float4.hpp"

namespace bodice::cloth {

using geometry::Index;
using geometry::Triangle;
using geometry::Vec3;

/// A pinned particle's mass to a coarse node, in its own masses.
inline constexpr float kPinnedMass = 1e3f;

/// #P each, up to the next multiple of four; world position = origin + (x, y, z). Within a substep the
/// positions are in `point`: x, y, z hold them before and after the constraints' part of it.
struct Particles {
  std::size_t size = 0;
  Vec3 origin = Vec3::Zero();
  std::vector<float> x, y, z;              ///< meters
  std::vector<float> old_x, old_y, old_z;  ///< meters, at the start of the substep
  std::vector<float> vx, vy, vz;           ///< meters a second
  std::vector<float> mass;                 ///< kilograms, the pinned ones too
  std::vector<float> inverse_mass;         ///< 0: pinned
  std::vector<Point> point;                ///< #P, those that idle slots of a schedule name, three more

  std::size_t count() const { return size; }
  Vec3 world(std::size_t i) const {
    return origin + Vec3(static_cast<double>(x[i]), static_cast<double>(y[i]), static_cast<double>(z[i]));
  }
};

/// Order that keeps neighbors in space near each other in memory (Morton code of the rest position, ties by
/// index): result[new] = old. Collision culls blocks of such particles, constraints hit the cache.
std::vector<Index> morton_order(const std::vector<Vec3>& positions);

/// Particles at rest at `mesh`'s positions, masses a third of each triangle's, not below a floor.
Particles make_particles(const geometry::TriMesh& mesh, double density_kg_m2,
                         const std::vector<bool>& pinned);

/// Moves the local frame; world positions stay, up to the rounding of floats.
void rebase(Particles& particles, const Vec3& origin);

}  // namespace bodice::cloth
