// The state of a solver.
#pragma once

#include <vector>

#include <bodice/cloth/solver.hpp>
#include <bodice/cloth/weld.hpp>

#include "base/nth_largest.hpp"
#include "base/particles.hpp"
#include "constraints/bend.hpp"
#include "constraints/coarse.hpp"
#include "constraints/stretch.hpp"
#include "constraints/tacks.hpp"
#include "contact/body_contact.hpp"
#include "motion/aerodynamics.hpp"
#include "motion/pins.hpp"
#include "motion/sleep.hpp"
#include "selfcontact/self_contact.hpp"
#include "solver/quality_controller.hpp"

namespace bodice::inline v0_1::cloth {

/// A garment in motion, with its constraints and contacts.
struct State {
  Fabric fabric;
  SolverOptions options;
  Particles particles;
  Pins pins;
  StretchConstraints stretch;
  BendConstraints bend;
  std::vector<Thread> threads;
  std::vector<CoarseLevel> coarse;
  Air air;
  ContactState contacts;
  Ring ring;
  SelfContact self;
  Sleep sleep;
  Budget budget;
  const collision::Collider* last_collider = nullptr;  ///< compared with, never dereferenced
  std::uint64_t last_proxy_hash = 0, last_poses = 0;
  std::vector<float> strain;    ///< the strain of each slot of edges at the end of the last frame
  float longest_strain = 0.0f;  ///< the largest of them
  std::vector<float> scratch;   ///< #P: room for one value a particle when a frame begins
  std::size_t slipping = 0;     ///< number of particles with reduced friction on a moving body
  Selection selection;
  float max_travel_m = 0.0f;  ///< the most that a particle may move in a substep
  double time_s = 0.0;        ///< simulated time

  std::vector<Vec3> input;                ///< #V: reported positions of dropped vertices
  std::vector<Index> particle_of_vertex;  ///< #V
  std::vector<engine::Warning> warnings;
};

/// Welds, orders the particles in space and builds all constraints.
engine::Result<State> make_state(const geometry::TriMesh& garment, std::span<const Index> pinned,
                                 const Fabric& fabric, const SolverOptions& options,
                                 std::span<const Tack> tacks = {});

/// Implements Solver::set_positions().
bool set_positions(std::span<const Vec3> world_positions, State& state);

/// Advances by one frame.
FrameReport advance(const engine::Context& context, const collision::Collider* collider, double dt_s,
                    State& state);

/// Adds strains, speeds and energies of the current state to the report, and sets `finite`.
void measure(const engine::Context& context, State& state, FrameReport& report);

}  // namespace bodice::cloth
