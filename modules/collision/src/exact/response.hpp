// One particle against the union, in double precision: the module's definition of both responses. The
// kernels push_by_planes the common case in floats and hand over what is left.
#pragma once

#include <span>

#include <bodice/collision/collider.hpp>

#include "exact/relief_field.hpp"
#include "exact/union_field.hpp"
#include "model/affine_motion.hpp"

namespace bodice::collision {

enum class Outcome : std::uint8_t {
  kClear,       ///< was outside and stays where it was
  kResolved,    ///< moved, and certified outside of every ellipsoid
  kPending,     ///< moved by the allowed push, still inside
  kUnresolved,  ///< still inside although no limit stopped it
};

struct ParticleState {
  geometry::Vec3 position;
  geometry::Vec3 velocity;
  geometry::Vec3 safe;  ///< carried along by the ellipsoid that the particle is nearest to
  geometry::Vec3 surface_velocity = geometry::Vec3::Zero();  ///< of the body where the particle is
  bool has_velocity = false;
  bool has_safe = false;
  std::span<const AffineMotion> affine_motions;         ///< one an ellipsoid; empty: the body rests
  geometry::Vec3 safe_before = geometry::Vec3::Zero();  ///< the safe position as it was before the body moved

  /// Where the path begins as ellipsoid k sees it.
  geometry::Vec3 path_start(std::size_t k) const {
    return affine_motions.empty() ? safe : affine_motions[k].apply(safe_before);
  }
};

/// What happened to one particle.
struct ParticleReport {
  Outcome outcome = Outcome::kClear;
  std::uint32_t ellipsoid = kNoEllipsoid;  ///< the deepest one
  double depth_m = 0.0;                    ///< below the clearance, before the response
  int iterations = 0;
  bool wrong_side = false;  ///< put back on the side where it came from
  bool fallback = false;    ///< not by iteration: by the path, or by the shortest of several certain ways out
  bool pinched = false;     ///< outside, but surfaces that face each other leave less room than the clearance
};

/// The closest point of the union's surface, corrected by `relief` unless that is null, raised by
/// `clearance_m` (which includes options.thickness_m); inward velocity removed, friction. Cost: 2 to 10
/// distances, some hundreds where the path from a safe position has to be followed or a fallback is needed.
ParticleReport resolve_closest_point(const UnionField& field, const ReliefTables* relief, double clearance_m,
                                     const ResolveOptions& options, ParticleState& particle);

/// The paper's section 4: the ray from the center of each ellipsoid that holds the particle, the exit with
/// the least distance, speed scaling by |c P0| / (|c P0| + |P0 p0|).
ParticleReport resolve_paper(const UnionField& field, double clearance_m, ParticleState& particle);

}  // namespace bodice::collision
