// XPBD cloth with small substeps against a collider: the garment side of the paper's sections 4 and 5.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <bodice/collision/collider.hpp>
#include <bodice/engine/context.hpp>
#include <bodice/engine/result.hpp>
#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::cloth {

/// Physical constants of a fabric; README of the module names the sources of the presets.
struct Fabric {
  std::string name;
  double density_kg_m2 = 0.15;
  double stretch_n_m = 1000.0;  ///< membrane stiffness, newtons a metre width
  double shear_n_m = 100.0;
  double bend_n_m = 1e-5;  ///< bending rigidity, newton metres
  double friction = 0.4;
  double damping_per_s = 0.5;
  double max_stretch = 0.05;  ///< strain limit
};

engine::Result<Fabric> find_fabric(std::string_view name);
std::vector<std::string> fabric_names();

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
  collision::Response response = collision::Response::kNearest;
  Environment environment;
  std::uint64_t seed = 0;
};

struct FrameReport {
  collision::ContactReport contacts;
  double stretch_p95 = 0.0, stretch_max = 0.0;  ///< edge strain
  double median_speed_m_s = 0.0;
  double kinetic_energy_j = 0.0;
  bool finite = true;
};

/// One garment (or several layers together) in motion. Not thread-safe; one frame at a time.
class Solver {
 public:
  /// `garment` in world metres; vertices at one place are one particle, isolated ones are dropped and
  /// reported. `pinned` are vertices of `garment` that do not move relative to the body.
  static engine::Result<Solver> make(const geometry::TriMesh& garment,
                                     std::span<const geometry::Index> pinned, const Fabric& fabric,
                                     const SolverOptions& options);
  ~Solver();
  Solver(Solver&&) noexcept;
  Solver& operator=(Solver&&) noexcept;

  /// Advances by dt_s (0 is a no-op that still reports). Allocates nothing once warm.
  FrameReport step(const engine::Context& context, const collision::Collider& collider, double dt_s);

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
