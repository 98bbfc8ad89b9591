// The responses for one particle in double precision: the definition that the kernels follow. The kernels
// settle common cases in floats and leave the rest to this.
#pragma once

#include <span>

#include <bodice/collision/collider.hpp>

#include "exact/relief_field.hpp"
#include "exact/union_field.hpp"
#include "model/affine_motion.hpp"

namespace bodice::inline v0_1::collision {

/// What a response made of one particle.
enum class Outcome : std::uint8_t {
  kClear,       ///< outside, not moved
  kResolved,    ///< moved, and certified to be outside of every ellipsoid
  kPending,     ///< moved by the longest push allowed, still inside
  kUnresolved,  ///< still inside although no limit stopped it
};

/// One particle in double precision; a response changes position and velocity.
struct ParticleState {
  geometry::Vec3 position;
  geometry::Vec3 velocity;
  geometry::Vec3 safe;  ///< safe position, moved with the ellipsoid that the particle is nearest to
  geometry::Vec3 surface_velocity = geometry::Vec3::Zero();  ///< velocity of the body at the particle
  bool has_velocity = false;
  bool has_safe = false;
  std::span<const AffineMotion> affine_motions;         ///< one an ellipsoid; empty: the body rests
  geometry::Vec3 safe_before = geometry::Vec3::Zero();  ///< safe position before the body moved

  /// Start of the particle's path relative to ellipsoid k: the safe position, moved with that ellipsoid.
  geometry::Vec3 path_start(std::size_t k) const {
    return affine_motions.empty() ? safe : affine_motions[k].apply(safe_before);
  }
};

/// Result of a response for one particle.
struct ParticleReport {
  Outcome outcome = Outcome::kClear;
  std::uint32_t ellipsoid = kNoEllipsoid;  ///< the deepest one
  double depth_m = 0.0;                    ///< below the clearance, before the response
  int iterations = 0;
  bool wrong_side = false;  ///< put back on the side that it came from
  bool fallback = false;    ///< resolved by following its path, or by the shortest of several certain exits
  bool pinched = false;     ///< outside, but facing surfaces leave less room than the clearance
};

/// Moves the particle to the closest point of the union's surface, raised by `clearance_m` (which includes
/// options.thickness_m). `relief` corrects the surface; it may be null. Inward velocity is removed, and
/// friction slows the rest.
/// Cost: 2 to 10 distances; some hundreds where the path from a safe position is followed or a fallback is
/// needed.
ParticleReport resolve_closest_point(const UnionField& field, const ReliefTables* relief, double clearance_m,
                                     const ResolveOptions& options, ParticleState& particle);

/// The paper's response, section 4: of the rays from the centers of the ellipsoids that contain the particle,
/// the exit at the least distance. Speed is scaled by |c P0| / (|c P0| + |P0 p0|).
ParticleReport resolve_paper(const UnionField& field, double clearance_m, ParticleState& particle);

}  // namespace bodice::collision
