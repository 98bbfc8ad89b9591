// Friction on positions: within a substep the tangential displacement of a touching particle is taken back as
// far as the cone allows, so that a garment at rest does not creep by g h a substep.
// Based on: Matthias Mueller et al. Detailed Rigid Body Simulation with Extended Position Based Dynamics.
// 2020. - section 3.5 (static friction on positions, zero restitution on velocities)
#include "contact.hpp"

#include <atomic>
#include <cmath>

#include <bodice/engine/parallel.hpp>

#include "tiny.hpp"

namespace bodice::cloth {
namespace {

// How fast a particle that is deeper than its last path explains is brought out: a garment that begins two
// centimetres inside is out after a frame, and neighbours feel no jerk.
constexpr float kRecovery_m_s = 1.0f;

collision::Particles view(Particles& p, bool with_velocities) {
  collision::Particles v;
  v.count = p.count();
  v.x = p.x.data(), v.y = p.y.data(), v.z = p.z.data();
  if (with_velocities) v.vx = p.vx.data(), v.vy = p.vy.data(), v.vz = p.vz.data();
  v.safe_x = p.old_x.data(), v.safe_y = p.old_y.data(), v.safe_z = p.old_z.data();
  return v;
}

void velocities_from_positions(Particles& p, std::size_t begin, std::size_t end, float inverse_h) {
  for (std::size_t i = begin; i < end; ++i) p.vx[i] = (p.x[i] - p.old_x[i]) * inverse_h;
  for (std::size_t i = begin; i < end; ++i) p.vy[i] = (p.y[i] - p.old_y[i]) * inverse_h;
  for (std::size_t i = begin; i < end; ++i) p.vz[i] = (p.z[i] - p.old_z[i]) * inverse_h;
}

// The push out is `depth` along n. Friction may take back that much times mu of the displacement along the
// surface; no velocity is left along n.
void friction_and_velocity(Particles& p, std::size_t i, float mu, float inverse_h) {
  const Point& before = p.point[i];
  const float px = p.x[i] - before.x, py = p.y[i] - before.y, pz = p.z[i] - before.z;
  const float depth = std::sqrt(px * px + py * py + pz * pz);
  const float nx = px / depth, ny = py / depth, nz = pz / depth;
  const float dx = p.x[i] - p.old_x[i], dy = p.y[i] - p.old_y[i], dz = p.z[i] - p.old_z[i];
  const float along_n = dx * nx + dy * ny + dz * nz;
  const float tx = dx - along_n * nx, ty = dy - along_n * ny, tz = dz - along_n * nz;
  const float slip = std::sqrt(tx * tx + ty * ty + tz * tz);
  const float kept = slip > mu * depth ? 1.0f - mu * depth / slip : 0.0f;
  p.x[i] -= (1.0f - kept) * tx, p.y[i] -= (1.0f - kept) * ty, p.z[i] -= (1.0f - kept) * tz;
  p.vx[i] = kept * tx * inverse_h, p.vy[i] = kept * ty * inverse_h, p.vz[i] = kept * tz * inverse_h;
}

void respond(Particles& p, ContactState& s, std::size_t i, bool paper, float mu, float inverse_h) {
  const Point& before = p.point[i];
  if (p.inverse_mass[i] == 0.0f) p.x[i] = before.x, p.y[i] = before.y, p.z[i] = before.z;
  s.touching[i] = p.x[i] != before.x || p.y[i] != before.y || p.z[i] != before.z;
  if (s.touching[i] && !paper) friction_and_velocity(p, i, mu, inverse_h);
}

}  // namespace

ContactState make_contacts(std::size_t particles) {
  ContactState s;
  s.touching.assign(particles, 0);
  return s;
}

std::uint32_t take_from_points(const engine::Context& context, Particles& p) {
  std::atomic<std::uint32_t> limits{0};
  engine::parallel_for(context, p.count(), kParticleGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Point& at = p.point[i];
      if (!std::isfinite(at.x + at.y + at.z)) {
        at.x = p.old_x[i], at.y = p.old_y[i], at.z = p.old_z[i];
        limits.fetch_or(kParticlesReset, std::memory_order_relaxed);
      }
      p.x[i] = at.x, p.y[i] = at.y, p.z[i] = at.z;
    }
  });
  return limits.load();
}

collision::ContactReport meet_body(const engine::Context& context, const collision::Collider* collider,
                                   const SolverOptions& options, float friction, float substep_s,
                                   ContactState& s, Particles& p) {
  const float inverse_h = 1.0f / substep_s;
  const bool paper = options.response == collision::Response::kPaper;
  auto velocities = [&](std::size_t begin, std::size_t end) {
    velocities_from_positions(p, begin, end, inverse_h);
  };
  if (paper || collider == nullptr) engine::parallel_for(context, p.count(), kParticleGrain, velocities);
  if (collider == nullptr) return {};
  const collision::ContactReport report =
      collider->resolve(context, view(p, paper),
                        {.response = options.response,
                         .thickness_m = static_cast<float>(options.thickness_m),
                         .friction = paper ? friction : 0.0f,
                         .max_push_m = kRecovery_m_s * substep_s},
                        s.workspace);
  engine::parallel_for(context, p.count(), kParticleGrain, [&](std::size_t begin, std::size_t end) {
    if (!paper) velocities(begin, end);
    for (std::size_t i = begin; i < end; ++i) respond(p, s, i, paper, friction, inverse_h);
  });
  return report;
}

}  // namespace bodice::cloth
