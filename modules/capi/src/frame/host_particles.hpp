// The host's particles as the engine takes them: where they are if they fit, else as copies in a workspace.
#pragma once

#include <bodice/collision/collider.hpp>

#include "arrays/strided.hpp"
#include "base/context.hpp"
#include "frame/workspace.hpp"

namespace bodice::capi {

/// Particles of the host, checked.
struct HostParticles {
  std::size_t count = 0;
  const std::uint32_t* index = nullptr;
  StridedVectors position, velocity, safe;
  Strided inverse_mass, mask;
  bool mass_is_double = false;
  bool is_local = false;

  /// The element of a particle.
  std::size_t element(std::size_t i) const { return index ? index[i] : i; }
  bool is_pinned(std::size_t element) const;
  /// Whether the engine can read and write the host's arrays themselves.
  bool fits_engine() const;
};

/// Reads and checks particles. O(#count) with an index, else O(1). Allocates nothing.
Outcome read_particles(const bodice_particles* given, HostParticles& out);

/// The host's particles in the engine's form. `origin` is that of the collider.
class EngineParticles {
 public:
  /// Copies what must be copied. With `drop_pinned`, pinned particles are left out; without, velocities are.
  EngineParticles(const HostParticles& host, const double (&origin)[3], bodice_workspace& workspace,
                  bool drop_pinned);

  const collision::Particles& engine() const { return engine_; }
  std::uint64_t pinned() const { return pinned_; }
  /// Writes back what a response changed; every other value of the host keeps its bits.
  void write_back() const;

 private:
  std::size_t element(std::size_t i) const { return element_ ? element_[i] : host_.element(i); }
  void copy_in(const StridedVectors& from, bool is_position, float* (&to)[3]);

  const HostParticles& host_;
  double origin_[3];
  collision::Particles engine_;
  const std::uint32_t* element_ = nullptr;  ///< element of each particle; null: the host's index has it
  const float* before_ = nullptr;           ///< what was copied, array after array, to know what has changed
  std::size_t length_ = 0;                  ///< number of values of one of these arrays
  std::uint64_t pinned_ = 0;
  bool copied_ = true;
  engine::Context context_;
};

}  // namespace bodice::capi
