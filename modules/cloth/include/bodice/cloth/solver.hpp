// XPBD cloth with small substeps against a collider: the garments of the paper's sections 4 and 5.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <bodice/cloth/fabric.hpp>
#include <bodice/collision/collider.hpp>
#include <bodice/engine/context.hpp>
#include <bodice/engine/result.hpp>
#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::inline v0_1::cloth {

/// The gravity, wind and air that act on a garment.
struct Environment {
  geometry::Vec3 gravity_m_s2 = {0.0, -9.81, 0.0};
  geometry::Vec3 wind_m_s = {0.0, 0.0, 0.0};
  double gust = 0.0;  ///< share of the wind that fluctuates, 0 to 1
  double air_density_kg_m3 = 1.2;
};

/// How a garment is simulated.
struct SolverOptions {
  int substeps = 8;    ///< substeps a frame; more of them make cloth stiffer
  int iterations = 1;  ///< sweeps over the constraints a substep
  /// Whether frames take twice the substeps while a moving body stretches cloth far beyond the limit of its
  /// fabric. Without them, a hem that a stride catches is pulled through the legs.
  bool doubled_when_stretched = false;
  double thickness_m = 0.001;  ///< distance that particles, edges and triangles keep from the proxy
  /// Whether edges and triangles keep the thickness between their particles as well. Not with kPaper.
  bool face_contact = true;
  /// The largest depth in the proxy that a point of a triangle may have at the end of a frame, meters, above
  /// zero. Deeper points are pushed out, and a proof is made for each triangle (FaceReport::proof). Absent:
  /// no proof. It needs face_contact, and one query for about every millimeter of cloth that touches. The
  /// proof is strict for proxies without relief. With relief it assumes that a distance falls by at most 1.5
  /// times the path. A few short paths of a thousand fall faster, at cliffs of up to 5 mm between tables.
  std::optional<double> certify_m = {};
  bool self_collision = true;  ///< whether layers of cloth stay apart and do not pass through each other
  /// Distance that layers of cloth keep from each other; a quarter of the median edge is its upper bound.
  /// Parts that are nearer at rest keep their distance at rest.
  double layer_gap_m = 0.0015;
  /// Whether the body and other layers of cloth may move pins off their targets. Such pins return at half a
  /// meter a second, and at once from more than a centimeter to it. Pins that do not yield stay on their
  /// targets, and layers that they press together cross.
  bool pins_yield = false;
  collision::Response response = collision::Response::kClosestPoint;
  Environment environment = {};
  std::uint64_t seed = 0;  ///< of the gusts
  /// Time that a frame may take, microseconds; 0: no budget. Each frame above it makes the next ones drop one
  /// thing more: self-contact, then bending in every second substep, then half of the substeps. The clock
  /// then affects the result, so that equal bits are promised only without a budget.
  double budget_us = 0.0;
};

/// Two vertices of a garment that a thread joins: they never come farther apart than they are at the start.
/// Threads sew pieces together, or a button to the cloth below it.
struct Tack {
  geometry::Index a = 0, b = 0;
};

/// The limits that a frame reached and the work that it dropped, as bits of FrameReport::limits.
enum FrameLimit : std::uint32_t {
  kTimeCut = 1u << 0,  ///< dt_s was longer than kMaxSubsteps substeps may be, and the rest was dropped; or it
                       ///< was under 1e-15 s and was dropped
  kMoreSubsteps = 1u << 1,  ///< the frame took more substeps than SolverOptions::substeps, because dt_s, a
                            ///< speed, or the stretch of cloth on a moving body was large
  kSpeedClamped = 1u << 2,  ///< a particle was slowed, because it would have crossed kMaxTravel in a substep
  kParticlesReset = 1u << 3,  ///< a particle became NaN or infinite and was returned to its last position
  kNoSelfContact = 1u << 4,   ///< the budget dropped self-contact
  kBendingHalved = 1u << 5,   ///< the budget dropped bending in every second substep
  kSubstepsHalved = 1u << 6   ///< the budget dropped half of the substeps
};

/// The longest substep: in a longer one a fold crosses thin parts of the body.
inline constexpr double kMaxSubstep_s = 1.0 / 120.0;
/// The most substeps of a frame, whatever dt_s.
inline constexpr int kMaxSubsteps = 128;
/// How far a particle may move in a substep, as a fraction of the diagonal of the garment at rest.
inline constexpr double kMaxTravel = 0.05;

/// Which triangles are proved to be no deeper in the proxy than a tolerance (SolverOptions::certify_m).
struct FaceProof {
  float tolerance_m = 0.0f;
  std::size_t open = 0;     ///< triangles without a proof; zero: no point of the cloth is deeper
  std::size_t samples = 0;  ///< points that were queried for it
};

/// Contact of edges and triangles with the body in a frame.
struct FaceReport {
  std::size_t samples = 0;     ///< points between particles that were near the body
  std::uint64_t contacts = 0;  ///< samples that were pushed, summed over the substeps
  float deepest_m = 0.0f;  ///< depth in the proxy of the deepest one at the end of the frame, to first order
  FaceProof proof;         ///< with SolverOptions::certify_m
};

/// Contact of the cloth with itself in a frame.
struct SelfContactReport {
  std::size_t pairs = 0;     ///< pairs of particle and triangle, or of two edges, that may touch
  std::size_t searches = 0;  ///< how often pairs were searched for anew
  std::size_t held = 0;      ///< particles that were held back from a crossing, summed over the substeps
  /// Pairs of triangles that cross now. They crossed at the start, or the body has pressed them through each
  /// other since.
  std::size_t crossing = 0;
};

/// The state of a garment after a frame, and the cost of the frame.
struct FrameReport {
  collision::ContactReport contacts;  ///< of particles, summed over the substeps
  FaceReport faces;
  SelfContactReport layers;
  double stretch_p95 = 0.0, stretch_max = 0.0;  ///< strain of edges, elongation only
  double median_speed_m_s = 0.0;  ///< median over particles of the distance moved in the frame, a second
  double kinetic_energy_j = 0.0;
  double gravity_energy_j = 0.0;  ///< potential energy, relative to the world's origin
  double elastic_energy_j = 0.0;  ///< energy of all edges and hinges, including the errors that sweeps leave
  double simulated_s = 0.0;       ///< dt_s, unless kTimeCut is set
  double frame_us = 0.0;          ///< duration of the step, by the context's clock
  double collision_us = 0.0;      ///< time inside the collider, summed over workers
  std::size_t asleep = 0;         ///< number of particles that sleep
  int substeps = 0;
  std::uint32_t limits = 0;  ///< FrameLimit bits
  bool finite = true;        ///< whether all positions and velocities are finite
};

/// One garment, or several layers of cloth together, in motion. Not thread-safe: it makes one frame at a
/// time.
class Solver {
 public:
  /// Makes the solver of a garment at rest.
  /// garment  #V x 3, world meters. Vertices at the same position become one particle. Isolated vertices are
  ///          dropped, and warnings() reports them.
  /// pinned   vertices of `garment` that the host moves with move_pins().
  /// tacks    threads of the garment. A tack of a missing or dropped vertex is left out.
  /// Fails with kInvalidArgument (fabric or options out of range) or kUnusableGeometry (no usable triangle).
  /// Cost: O(#V log #V).
  static engine::Result<Solver> make(const geometry::TriMesh& garment,
                                     std::span<const geometry::Index> pinned, const Fabric& fabric,
                                     const SolverOptions& options, std::span<const Tack> tacks = {});
  ~Solver();
  Solver(Solver&&) noexcept;
  Solver& operator=(Solver&&) noexcept;

  /// Advances by dt_s. With 0 nothing moves, but the report is still made. It allocates nothing once warm.
  /// For a body that moves, call collider.move_to(shapes, dt_s) before each step, and once more with the same
  /// shapes when it stops. The context's cancellation is ignored: a frame that has begun is finished. Cost:
  /// O(substeps x iterations x #V), and for self-contact O(#pairs of nearby parts) in each substep;
  /// `bench/cloth` measures it.
  FrameReport step(const engine::Context& context, const collision::Collider& collider, double dt_s);
  /// Advances by dt_s without a body.
  FrameReport step(const engine::Context& context, double dt_s);

  /// Moves the garment to other positions (#V, world meters) and stops it. Lengths at rest stay those of
  /// make(). Vertices that became one particle take the position of the first of them. Returns false and
  /// changes nothing if their number differs or a value is not finite.
  [[nodiscard]] bool set_positions(std::span<const geometry::Vec3> world_positions);
  /// Sets the positions of the pinned vertices at the end of the next step, in the order given to make().
  /// They move there in a straight line over the substeps. A value that is not finite leaves its pin
  /// unchanged; a new target wakes all sleeping particles.
  void move_pins(std::span<const geometry::Vec3> world_positions);
  /// Sets gravity and air from the next step on, and wakes all sleeping particles. Fails with
  /// kInvalidArgument as make().
  engine::Result<void> set_environment(const Environment& environment);
  /// Gives every free particle this velocity, and wakes all sleeping particles.
  void set_velocity(const geometry::Vec3& velocity_m_s);

  /// The number of particles.
  std::size_t particles() const noexcept;
  /// Writes the world positions of the garment's vertices (#V).
  void positions(std::span<geometry::Vec3> out) const;
  /// The warnings of make() about vertices, triangles and pins that it dropped.
  std::span<const engine::Warning> warnings() const noexcept;
  /// A hash of positions and velocities.
  std::uint64_t hash() const noexcept;

 private:
  struct Impl;
  explicit Solver(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace bodice::cloth
