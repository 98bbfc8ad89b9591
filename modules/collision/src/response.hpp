// One particle against the union, in double precision: the module's definition of both responses. The
// kernels settle the common case in floats and hand over what is left.
#pragma once

#include <bodice/collision/collider.hpp>

#include "halfspaces.hpp"
#include "union_field.hpp"

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
  geometry::Vec3 safe;
  bool has_velocity = false;
  bool has_safe = false;
};

/// What happened to one particle.
struct ParticleReport {
  Outcome outcome = Outcome::kClear;
  std::uint32_t ellipsoid = kNoEllipsoid;  ///< the deepest one
  double depth_m = 0.0;                    ///< below the clearance, before the response
  int iterations = 0;
  bool wrong_side = false;  ///< put back on the side where it came from
  bool fallback = false;    ///< resolved by a ray or by the path, not by iteration
};

/// The nearest point of the union's surface, raised by `clearance_m`; inward velocity removed, friction.
ParticleReport resolve_nearest(const UnionField& field, double clearance_m, const ResolveOptions& options,
                               ParticleState& particle);

/// The paper's section 4: the ray from the centre of each ellipsoid that holds the particle, the exit with
/// the least distance, speed scaling by |c P0| / (|c P0| + |P0 p0|).
ParticleReport resolve_paper(const UnionField& field, double clearance_m, ParticleState& particle);

}  // namespace bodice::collision
