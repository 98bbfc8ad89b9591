// XPBD cloth with small substeps against a collider: the garment side of the paper's sections 4 and 5.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <bodice/cloth/fabric.hpp>
#include <bodice/collision/collider.hpp>
#include <bodice/engine/context.hpp>
#include <bodice/engine/result.hpp>
#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::cloth {

struct Environment {
  geometry::Vec3 gravity_m_s2 = {0.0, -9.81, 0.0};
  geometry::Vec3 wind_m_s = {0.0, 0.0, 0.0};
  double gust = 0.0;  ///< 0..1, share of the wind that fluctuates
  double air_density_kg_m3 = 1.2;
};

struct SolverOptions {
  int substeps = 8;
  int iterations = 1;          ///< constraint sweeps a substep
  double thickness_m = 0.001;  ///< cloth kept this far from the proxy
  bool self_collision = true;
  collision::Response response = collision::Response::kClosestPoint;
  Environment environment;
  std::uint64_t seed = 0;
  /// Time a frame may take; 0: no budget. A frame above it makes the next ones do without, in this order:
  /// self-contact, bending on every second substep, half of the substeps. The clock then takes part in the
  /// result, so that equal bits are promised only without a budget.
  double budget_us = 0.0;
};

/// What a frame had to leave out or bound, as bits of FrameReport::limits.
enum FrameLimit : std::uint32_t {
  kTimeCut = 1u << 0,       ///< dt_s was above what kMaxSubsteps substeps may cover, the rest was dropped; or
                            ///< under 1e-15 s, and all of it was
  kMoreSubsteps = 1u << 1,  ///< more substeps than asked for, because dt_s or the speeds were large
  kSpeedClamped = 1u << 2,  ///< a particle would have crossed kMaxTravel in a substep and was slowed
  kParticlesReset = 1u << 3,  ///< a particle became NaN or infinite and was put back where it was
  kNoSelfContact = 1u << 4,   ///< dropped for the budget
  kBendingHalved = 1u << 5,   ///< for the budget: on every second substep only
  kSubstepsHalved = 1u << 6   ///< for the budget
};

/// A substep is never longer than this: beyond it a fold crosses the body's thin parts in one step.
inline constexpr double kMaxSubstep_s = 1.0 / 120.0;
/// A frame never has more substeps than this, whatever dt_s.
inline constexpr int kMaxSubsteps = 128;
/// No particle moves further in a substep than this share of the rest garment's diagonal.
inline constexpr double kMaxTravel = 0.05;

struct FrameReport {
  collision::ContactReport contacts;            ///< summed over the substeps
  double stretch_p95 = 0.0, stretch_max = 0.0;  ///< edge strain, elongation only
  double median_speed_m_s = 0.0;                ///< of the distances covered in the frame
  double kinetic_energy_j = 0.0;
  double gravity_energy_j = 0.0;  ///< potential, relative to the world's origin
  double elastic_energy_j = 0.0;  ///< of edges and hinges as they stand, what a sweep left over included
  double simulated_s = 0.0;       ///< dt_s, unless kTimeCut
  double frame_us = 0.0;          ///< the step, by the context's clock
  double collision_us = 0.0;      ///< inside the collider, summed over workers
  std::size_t asleep = 0;         ///< particles that hold still
  int substeps = 0;
  std::uint32_t limits = 0;  ///< FrameLimit bits
  bool finite = true;
};

/// One garment (or several layers together) in motion. Not thread-safe; one frame at a time.
class Solver {
 public:
  /// `garment` in world meters; vertices at one place are one particle, isolated ones are dropped and
  /// reported. `pinned` are vertices of `garment` that do not move relative to the body.
  static engine::Result<Solver> make(const geometry::TriMesh& garment,
                                     std::span<const geometry::Index> pinned, const Fabric& fabric,
                                     const SolverOptions& options);
  ~Solver();
  Solver(Solver&&) noexcept;
  Solver& operator=(Solver&&) noexcept;

  /// Advances by dt_s (0 is a no-op that still reports). Allocates nothing once warm. A body that moves: call
  /// collider.move_to(shapes, dt_s) before each step, and with the same shapes again once it stands still.
  /// A frame begun is finished: the context's cancellation is not looked at.
  FrameReport step(const engine::Context& context, const collision::Collider& collider, double dt_s);
  /// The same without a body.
  FrameReport step(const engine::Context& context, double dt_s);

  /// Where the pinned vertices are to be at the end of the next step, in the order given to make(); they
  /// move there in a straight line over its substeps. Values that are not finite leave their pin where it is;
  /// a new target wakes what sleeps.
  void move_pins(std::span<const geometry::Vec3> world_positions);
  /// Gravity and air from the next step on; wakes what sleeps. kInvalidArgument as in make().
  engine::Result<void> set_environment(const Environment& environment);
  /// Gives every free particle this velocity, and wakes what sleeps.
  void set_velocity(const geometry::Vec3& velocity_m_s);

  std::size_t particles() const noexcept;
  /// World positions of the input garment's vertices (#V of the garment), through the weld map.
  void positions(std::span<geometry::Vec3> out) const;
  std::span<const engine::Warning> warnings() const noexcept;
  std::uint64_t hash() const noexcept;  ///< of positions and velocities

 private:
  struct Impl;
  explicit Solver(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace bodice::cloth
