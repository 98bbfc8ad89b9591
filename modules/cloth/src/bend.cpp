// Based on: Miklos Bergou, Max Wardetzky, David Harmon, Denis Zorin, Eitan Grinspun. A Quadratic Bending
// Model for Inextensible Surfaces. 2006. - eq. (3), the cotangent stencil K of a hinge. Differs: the
// stencil's vector K x is as long as edge * angle and lies along the hinge's normal n under isometry, so the
// constraint is the signed number n . K x, which keeps a curved rest shape and costs one normal; its gradient
// holds n fixed. The energy is B (K x)^2 / (2 A) with A the area of both triangles: a strip of width e bent
// by the angle t at folds h apart stores B t^2 e / (2 h), and e h = A. Beside it, friction between yarns: a
// spring to where the hinge was held last, which gives way above a moment, so that a small swing of a fold
// ends. Based on: Paul Dahl. A Solid Friction Model. 1968. (here with an abrupt slip)
#include "bend.hpp"

#include <algorithm>
#include <cmath>

#include <bodice/engine/parallel.hpp>

#include "kernels.hpp"
#include "tiny.hpp"

namespace bodice::cloth {
namespace {

// A sliver's cotangent beyond this (0.06 degrees) would only put weights of 1e3 into floats.
constexpr double kMaxCotangent = 1e3;

// Stiffness of the held hinge in bending stiffnesses: it slips after a bend too slight to be seen.
constexpr float kStick = 20.0f;

double cotangent(const Vec3& corner, const Vec3& u, const Vec3& v) {
  const Vec3 a = u - corner, b = v - corner;
  const double cross = a.cross(b).norm();
  return cross > 0.0 ? std::clamp(a.dot(b) / cross, -kMaxCotangent, kMaxCotangent) : 0.0;
}

struct Stencil {
  std::array<double, 4> k;
  double rest;
  double area;
};

Stencil stencil(const geometry::TriMesh& mesh, const Hinge& h) {
  const Vec3 &a = mesh.positions[h.a], &b = mesh.positions[h.b], &c = mesh.positions[h.c],
             &d = mesh.positions[h.d];
  const double ac = cotangent(a, b, c), bc = cotangent(b, a, c), ad = cotangent(a, b, d),
               bd = cotangent(b, a, d);
  Stencil s{{bc + bd, ac + ad, -(ac + bc), -(ad + bd)}, 0.0, 0.0};
  const Vec3 normal = (b - a).cross(c - d);
  const double length = normal.norm();
  const Vec3 bent = s.k[0] * a + s.k[1] * b + s.k[2] * c + s.k[3] * d;
  s.rest = length > 0.0 ? bent.dot(normal) / length : 0.0;
  s.area = 0.5 * ((b - a).cross(c - a).norm() + (b - a).cross(d - a).norm());
  return s;
}

}  // namespace

BendConstraints make_bend(const geometry::TriMesh& mesh, const Topology& topology, const Fabric& fabric,
                          const Particles& particles) {
  BendConstraints out;
  if (fabric.bend_n_m <= 0.0) return out;
  const bool held = fabric.bend_friction_n > 0.0;
  out.soften = held ? 1.0f / (1.0f + kStick) : 1.0f;
  out.slip_n = static_cast<float>(fabric.bend_friction_n) / kStick;
  std::vector<Index> corners;
  for (const Hinge& h : topology.hinges) corners.insert(corners.end(), {h.a, h.b, h.c, h.d});
  out.schedule = make_schedule(corners, 4, particles.count());
  for (std::size_t slot = 0; slot < out.schedule.slot.size(); ++slot) {
    const std::uint32_t h = out.schedule.slot[slot];
    const Stencil s = h == kIdle ? Stencil{{}, 0.0, 1.0} : stencil(mesh, topology.hinges[h]);
    for (std::size_t q = 0; q < 4; ++q) {
      out.corner[q].push_back(h == kIdle ? out.schedule.idle[slot / kPack] : corners[4 * h + q]);
      out.k[q].push_back(static_cast<float>(s.k[q]));
    }
    out.rest_m.push_back(static_cast<float>(s.rest));
    out.compliance.push_back(static_cast<float>(s.area / fabric.bend_n_m));
  }
  out.held.assign(out.rest_m.size(), 0.0f);
  return out;
}

void solve_bend_block(BendConstraints& c, std::size_t block, float inverse_h2, Particles& p) {
  if (c.schedule.packs() == 0) return;
  solve_bend_packs(c, {c.schedule.block_begin[block], c.schedule.block_begin[block + 1]}, inverse_h2,
                   p.point.data());
}

void solve_bend_across(const engine::Context& context, BendConstraints& c, float inverse_h2, Particles& p) {
  for_each_across(context, c.schedule, [&](std::size_t begin, std::size_t end) {
    solve_bend_packs(c, {begin, end}, inverse_h2, p.point.data());
  });
}

double bend_energy(const engine::Context& context, const BendConstraints& c, const Particles& p) {
  return engine::ordered_reduce(
      context, c.schedule.packs(), reduce_grain(c.schedule.packs()), 0.0,
      [&](std::size_t begin, std::size_t end) {
        return bend_energy_packs(c, {begin, end}, p.point.data());
      },
      [](double l, double r) { return l + r; });
}

}  // namespace bodice::cloth
