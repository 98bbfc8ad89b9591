#include <bodice/cloth/solver.hpp>

#include <bodice/engine/hash.hpp>

#include "base/check_options.hpp"
#include "solver/state.hpp"

namespace bodice::inline v0_1::cloth {

struct Solver::Impl {
  State state;
};

Solver::Solver(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Solver::~Solver() = default;
Solver::Solver(Solver&&) noexcept = default;
Solver& Solver::operator=(Solver&&) noexcept = default;

engine::Result<Solver> Solver::make(const geometry::TriMesh& garment, std::span<const geometry::Index> pinned,
                                    const Fabric& fabric, const SolverOptions& options,
                                    std::span<const Tack> tacks) {
  auto state = make_state(garment, pinned, fabric, options, tacks);
  if (!state) return state.error();
  return Solver(std::make_unique<Impl>(Impl{std::move(*state)}));
}

FrameReport Solver::step(const engine::Context& context, const collision::Collider& collider, double dt_s) {
  engine::Context whole = context;
  whole.cancel = {};  // a frame canceled halfway would leave the garment in an invalid state
  return advance(whole, &collider, dt_s, impl_->state);
}

FrameReport Solver::step(const engine::Context& context, double dt_s) {
  engine::Context whole = context;
  whole.cancel = {};
  return advance(whole, nullptr, dt_s, impl_->state);
}

bool Solver::set_positions(std::span<const geometry::Vec3> world_positions) {
  return cloth::set_positions(world_positions, impl_->state);
}

void Solver::move_pins(std::span<const geometry::Vec3> world_positions) {
  // Constraints cannot move sleeping particles, so that edges between them and moving pins would stretch.
  if (set_pin_targets(world_positions, impl_->state.pins)) wake_all(impl_->state.sleep);
}

engine::Result<void> Solver::set_environment(const Environment& environment) {
  if (auto good = check(environment); !good) return good;
  impl_->state.options.environment = environment;
  wake_all(impl_->state.sleep);
  return {};
}

void Solver::set_velocity(const geometry::Vec3& velocity_m_s) {
  Particles& p = impl_->state.particles;
  if (!velocity_m_s.allFinite()) return;
  wake_all(impl_->state.sleep);
  for (std::size_t i = 0; i < p.count(); ++i) {
    if (p.inverse_mass[i] == 0.0f) continue;
    p.vx[i] = static_cast<float>(velocity_m_s[0]);
    p.vy[i] = static_cast<float>(velocity_m_s[1]);
    p.vz[i] = static_cast<float>(velocity_m_s[2]);
  }
}

std::size_t Solver::particles() const noexcept {
  return impl_->state.particles.count();
}

void Solver::positions(std::span<geometry::Vec3> out) const {
  const State& s = impl_->state;
  for (std::size_t v = 0; v < out.size() && v < s.input.size(); ++v) {
    const Index p = s.particle_of_vertex[v];
    out[v] = p == geometry::kNoIndex ? s.input[v] : s.particles.world(p);
  }
}

std::span<const engine::Warning> Solver::warnings() const noexcept {
  return impl_->state.warnings;
}

std::uint64_t Solver::hash() const noexcept {
  const Particles& p = impl_->state.particles;
  engine::Hasher hasher;
  for (const auto* a : {&p.x, &p.y, &p.z, &p.vx, &p.vy, &p.vz}) hasher.add(std::span<const float>(*a));
  return hasher.value();
}

}  // namespace bodice::cloth
