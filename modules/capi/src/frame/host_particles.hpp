// The host's particles as the engine takes them: checked, without those that are pinned, where they are.
#pragma once

#include <bodice/collision/strided_particles.hpp>

#include "arrays/strided.hpp"
#include "base/context.hpp"
#include "frame/workspace.hpp"

namespace bodice::inline v0_1::capi {

/// Particles of the host, checked.
struct HostParticles {
  std::size_t count = 0, elements = 0;
  const std::uint32_t* index = nullptr;
  StridedVectors position, velocity, safe;
  Strided inverse_mass, mask;
  bool mass_is_double = false;
  bool is_local = false;

  /// The element of a particle.
  std::size_t element(std::size_t i) const { return index ? index[i] : i; }
  bool is_pinned(std::size_t element) const;
};

/// Reads and checks particles. O(#count) with an index, else O(1). Allocates nothing.
Outcome read_particles(const bodice_particles* given, HostParticles& out);

/// The host's particles in the engine's form, which reads and writes them where they are.
struct EngineParticles {
  collision::StridedParticles particles;
  std::uint64_t pinned = 0;  ///< particles that are left out
  bool all_differ = true;    ///< no element stands in the host's index twice
};

/// Particles to query, without velocities. `origin` is that of the collider. O(1); allocates nothing.
EngineParticles to_query(const HostParticles& host, const double (&origin)[3]);
/// Particles to move, without those that are pinned. O(#count) with an index, mask or mass, else O(1).
EngineParticles to_resolve(const HostParticles& host, const double (&origin)[3], bodice_workspace& workspace);

}  // namespace bodice::capi
