#pragma once

#include <vector>

#include <bodice/cloth/solver.hpp>
#include <bodice/cloth/weld.hpp>

#include "base/nth_largest.hpp"
#include "base/particles.hpp"
#include "constraints/bend.hpp"
#include "constraints/coarse.hpp"
#include "constraints/stretch.hpp"
#include "contact/body_contact.hpp"
#include "contact/self_contact.hpp"
#include "motion/aerodynamics.hpp"
#include "motion/pins.hpp"
#include "motion/sleep.hpp"
#include "solver/quality_controller.hpp"

namespace bodice::cloth {

/// Everything a garment in motion is made of.
struct State {
  Fabric fabric;
  SolverOptions options;
  Particles particles;
  Pins pins;
  StretchConstraints stretch;
  BendConstraints bend;
  std::vector<CoarseLevel> coarse;
  Air air;
  ContactState contacts;
  Ring ring;
  SelfContact self;
  Sleep sleep;
  Budget budget;
  const collision::Collider* last_collider = nullptr;  ///< compared, never read
  std::uint64_t last_proxy_hash = 0, last_poses = 0;
  std::vector<float> scratch;  ///< #slots of edges, strains
  Selection selection;
  float max_travel_m = 0.0f;  ///< a substep
  double time_s = 0.0;

  std::vector<Vec3> input;                ///< #V, where dropped vertices stay
  std::vector<Index> particle_of_vertex;  ///< #V
  std::vector<engine::Warning> warnings;
};

/// Welds, orders the particles in space and builds all constraints.
engine::Result<State> make_state(const geometry::TriMesh& garment, std::span<const Index> pinned,
                                 const Fabric& fabric, const SolverOptions& options);

/// Advances by one frame.
FrameReport advance(const engine::Context& context, const collision::Collider* collider, double dt_s,
                    State& state);

/// Strains, speeds and energies of the present state; sets `finite`.
void measure(const engine::Context& context, State& state, FrameReport& report);

}  // namespace bodice::cloth
