// A particle's share of the surface counts as a flat plate. The relative velocity along the normal meets the
// plate's drag, and the velocity along the surface meets skin friction. The component of the normal force
// across the wind is the lift.
// Based on: Sighard Hoerner. Fluid-Dynamic Drag. 1965. (plates: 1.17 if square, 2 if long; skin friction
// 0.005 to 0.05)
#include "motion/aerodynamics.hpp"

#include <algorithm>
#include <cmath>

#include <bodice/engine/parallel.hpp>

#include "base/gust.hpp"
#include "base/tolerances.hpp"

namespace bodice::inline v0_1::cloth {
namespace {

constexpr float kNormalCoefficient = 1.2f;
constexpr float kTangentCoefficient = 0.03f;

void update_triangles(const Particles& p, Air& air, std::size_t begin, std::size_t end) {
  for (std::size_t t = begin; t < end; ++t) {
    const auto [a, b, c] = air.triangles[t];
    const float ux = p.x[b] - p.x[a], uy = p.y[b] - p.y[a], uz = p.z[b] - p.z[a];
    const float vx = p.x[c] - p.x[a], vy = p.y[c] - p.y[a], vz = p.z[c] - p.z[a];
    constexpr float kSixth = 1.0f / 6.0f;
    air.tri_x[t] = kSixth * (uy * vz - uz * vy);
    air.tri_y[t] = kSixth * (uz * vx - ux * vz);
    air.tri_z[t] = kSixth * (ux * vy - uy * vx);
  }
}

// Finds the normal and the area of a particle. Neighboring triangles may have opposite windings; each is
// turned to the side of the first one, which is right unless the surface is folded sharply.
void update_normal(Air& air, std::size_t i) {
  float sx = 0.0f, sy = 0.0f, sz = 0.0f, area = 0.0f;
  for (Index k = air.corner_begin[i]; k < air.corner_begin[i + 1]; ++k) {
    const Index t = air.corner_triangle[k];
    const float tx = air.tri_x[t], ty = air.tri_y[t], tz = air.tri_z[t];
    const float side = tx * sx + ty * sy + tz * sz < 0.0f ? -1.0f : 1.0f;
    sx += side * tx, sy += side * ty, sz += side * tz;
    area += std::sqrt(tx * tx + ty * ty + tz * tz);
  }
  const float length = std::sqrt(sx * sx + sy * sy + sz * sz);
  const float scale = length > 0.0f ? 1.0f / length : 0.0f;
  air.nx[i] = sx * scale, air.ny[i] = sy * scale, air.nz[i] = sz * scale;
  air.area_m2[i] = area;
}

// The wind at a point of the world, with its gust.
Vec3 wind_at(const Environment& environment, std::uint64_t seed, double time_s, const Vec3& point) {
  const bool gusty = environment.gust > 0.0 && environment.wind_m_s.squaredNorm() > 0.0;
  if (!gusty) return environment.wind_m_s;
  return environment.wind_m_s * gust_factor(environment, seed, time_s, point);
}

}  // namespace

Air make_air(const geometry::TriMesh& mesh) {
  Air air;
  air.triangles = mesh.triangles;
  const std::size_t count = mesh.positions.size();
  air.corner_begin.assign(count + 1, 0);
  for (const Triangle& t : mesh.triangles) {
    for (const Index v : t) ++air.corner_begin[v + 1];
  }
  for (std::size_t i = 0; i < count; ++i) air.corner_begin[i + 1] += air.corner_begin[i];
  air.corner_triangle.resize(3 * mesh.triangles.size());
  std::vector<Index> next(air.corner_begin.begin(), air.corner_begin.end() - 1);
  for (Index t = 0; t < mesh.triangles.size(); ++t) {
    for (const Index v : mesh.triangles[t]) air.corner_triangle[next[v]++] = t;
  }
  for (auto* a : {&air.tri_x, &air.tri_y, &air.tri_z}) a->assign(mesh.triangles.size(), 0.0f);
  for (auto* a : {&air.nx, &air.ny, &air.nz, &air.area_m2, &air.wind_x, &air.wind_y, &air.wind_z}) {
    a->assign((count + 3) / 4 * 4, 0.0f);
  }
  return air;
}

void update_air(const engine::Context& context, const Environment& environment, std::uint64_t seed,
                double time_s, const Particles& particles, Air& air) {
  engine::parallel_for(
      context, air.triangles.size(), kParticleGrain,
      [&](std::size_t begin, std::size_t end) { update_triangles(particles, air, begin, end); });
  engine::parallel_for(context, particles.count(), kParticleGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      update_normal(air, i);
      const Vec3 wind = wind_at(environment, seed, time_s, particles.world(i));
      air.wind_x[i] = static_cast<float>(wind[0]);
      air.wind_y[i] = static_cast<float>(wind[1]);
      air.wind_z[i] = static_cast<float>(wind[2]);
    }
  });
}

void accelerate(const Environment& environment, const Air& air, float substep_s, std::size_t begin,
                std::size_t end, Particles& p) {
  const Float4 gx = splat(static_cast<float>(environment.gravity_m_s2[0]) * substep_s);
  const Float4 gy = splat(static_cast<float>(environment.gravity_m_s2[1]) * substep_s);
  const Float4 gz = splat(static_cast<float>(environment.gravity_m_s2[2]) * substep_s);
  const Float4 pressure = splat(0.5f * static_cast<float>(environment.air_density_kg_m3) * substep_s);
  for (std::size_t i = begin; i < end; i += 4) {
    const Float4 vx = load(&p.vx[i]), vy = load(&p.vy[i]), vz = load(&p.vz[i]);
    const Float4 rx = load(&air.wind_x[i]) - vx, ry = load(&air.wind_y[i]) - vy,
                 rz = load(&air.wind_z[i]) - vz;
    const Float4 speed = square_root(rx * rx + ry * ry + rz * rz);
    // An implicit step of dv/dt = k |r| r gives the particle the share k / (1 + k) of the relative velocity
    // r.
    const Float4 rate = pressure * load(&air.area_m2[i]) * speed * load(&p.inverse_mass[i]);
    const Float4 along = rate * kTangentCoefficient / (1.0f + rate * kTangentCoefficient);
    const Float4 across = rate * kNormalCoefficient / (1.0f + rate * kNormalCoefficient) - along;
    const Float4 nx = load(&air.nx[i]), ny = load(&air.ny[i]), nz = load(&air.nz[i]);
    const Float4 normal = across * (rx * nx + ry * ny + rz * nz);
    store(&p.vx[i], vx + gx + along * rx + normal * nx);
    store(&p.vy[i], vy + gy + along * ry + normal * ny);
    store(&p.vz[i], vz + gz + along * rz + normal * nz);
  }
}

}  // namespace bodice::cloth
