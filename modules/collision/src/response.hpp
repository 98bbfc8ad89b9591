// One particle against the union, in double precision: the module's definition of both responses. The
// kernels settle the common case in floats and hand over what is left.
#pragma once

#include <bodice/collision/collider.hpp>

#include "halfspaces.hpp"
#include "relief_field.hpp"
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
  geometry::Vec3 surface_velocity = geometry::Vec3::Zero();  ///< of the body where the particle is
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

/// The end of every response: the particle goes from p to x, or max_push_m of the way, and its velocity loses
/// the part that goes into `contact` and, by friction, some of the rest.
void move(const geometry::Vec3& p, const geometry::Vec3& x, const Halfspaces& contact,
          const ResolveOptions& options, ParticleReport& report, ParticleState& particle);

/// The nearest point of the union's surface, raised by `clearance_m`; inward velocity removed, friction.
ParticleReport resolve_nearest(const UnionField& field, double clearance_m, const ResolveOptions& options,
                               ParticleState& particle);

/// The same for the corrected distance of relief.hpp.
ParticleReport resolve_relief(const UnionField& field, const ReliefTables& relief, double clearance_m,
                              const ResolveOptions& options, ParticleState& particle);

/// The paper's section 4: the ray from the centre of each ellipsoid that holds the particle, the exit with
/// the least distance, speed scaling by |c P0| / (|c P0| + |P0 p0|).
ParticleReport resolve_paper(const UnionField& field, double clearance_m, ParticleState& particle);

}  // namespace bodice::collision
