// Based on: Miklos Bergou, Max Wardetzky, David Harmon, Denis Zorin, Eitan Grinspun. A Quadratic Bending
// Model for Inextensible Surfaces. 2006. - eq. (3), the cotangent stencil K of a hinge.
// Differs: under isometry the vector K x is as long as edge * angle and lies along the hinge's normal n. The
// constraint is the signed number n . K x, which keeps a curved rest shape and costs one normal; its gradient
// holds n fixed. The energy is B (K x)^2 / (2 A), with A the area of both triangles: a strip of width e, bent
// by the angle t at folds h apart, stores B t^2 e / (2 h), and e h = A.
// Based on: Paul Dahl. A Solid Friction Model. 1968. (friction between yarns)
// Differs: a second spring pulls the hinge to the value at which it is held. Above a moment the held value
// slips at once, so that small swings of a fold end.
#include "constraints/bend.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include <bodice/engine/parallel.hpp>

#include "base/tolerances.hpp"
#include "constraints/kernels.hpp"

namespace bodice::inline v0_1::cloth {
namespace {

// The largest cotangent (0.06 degrees): slivers would otherwise give weights that floats cannot combine with
// others.
constexpr double kMaxCotangent = 1e3;

// The stiffness of friction's spring, as a multiple of the bending stiffness. It is so stiff that friction
// slips after a bend too slight to be visible.
constexpr float kStick = 20.0f;

double cotangent(const Vec3& corner, const Vec3& u, const Vec3& v) {
  const Vec3 a = u - corner, b = v - corner;
  const double cross = a.cross(b).norm();
  return cross > 0.0 ? std::clamp(a.dot(b) / cross, -kMaxCotangent, kMaxCotangent) : 0.0;
}

struct Stencil {
  std::array<Half, 3> k = {};  // weights of b, c and d
  double rest = 0.0;
  double area = 1.0;
};

// The stencil of a hinge. The rest value is computed with the rounded weights.
Stencil stencil(const geometry::TriMesh& mesh, const Hinge& h) {
  const Vec3 &a = mesh.positions[h.a], &b = mesh.positions[h.b], &c = mesh.positions[h.c],
             &d = mesh.positions[h.d];
  const double ac = cotangent(a, b, c), bc = cotangent(b, a, c), ad = cotangent(a, b, d),
               bd = cotangent(b, a, d);
  Stencil s{{to_half(ac + ad), to_half(-(ac + bc)), to_half(-(ad + bd))}};
  auto weight = [&](std::size_t corner) { return static_cast<double>(to_float(s.k[corner])); };
  const Vec3 normal = (b - a).cross(c - d);
  const double length = normal.norm();
  const Vec3 bent = weight(0) * (b - a) + weight(1) * (c - a) + weight(2) * (d - a);
  s.rest = length > 0.0 ? bent.dot(normal) / length : 0.0;
  s.area = 0.5 * ((b - a).cross(c - a).norm() + (b - a).cross(d - a).norm());
  return s;
}

template <class Id>
void put(const Hinge& hinge, const Stencil& stencil, double bend_n_m, Index first, std::size_t k,
         HingePack<Id>& pack) {
  const Index corners[] = {hinge.a, hinge.b, hinge.c, hinge.d};
  for (std::size_t q = 0; q < 4; ++q) pack.corner[q][k] = static_cast<Id>(corners[q] - first);
  for (std::size_t q = 0; q < 3; ++q) pack.k[q][k] = stencil.k[q];
  pack.compliance[k] = to_half(stencil.area / bend_n_m);
  pack.rest_m[k] = static_cast<float>(stencil.rest);
  pack.held[k] = 0.0f;
}

}  // namespace

BendConstraints make_bend(const geometry::TriMesh& mesh, const Topology& topology, const Fabric& fabric,
                          const Particles& particles) {
  BendConstraints out;
  if (fabric.bend_n_m <= 0.0) return out;
  const bool held = fabric.bend_friction_n > 0.0;
  out.yarn.soften = held ? 1.0f / (1.0f + kStick) : 1.0f;
  out.yarn.slip_n = static_cast<float>(fabric.bend_friction_n) / kStick;
  std::vector<Index> corners;
  for (const Hinge& h : topology.hinges) corners.insert(corners.end(), {h.a, h.b, h.c, h.d});
  out.schedule = make_schedule(corners, 4, particles.count());
  const std::size_t inside = out.schedule.packs_inside();
  out.inside.resize(inside), out.across.resize(out.schedule.packs() - inside);
  for_each_slot(out.schedule, particles.count(),
                [&](std::size_t pack, std::size_t k, std::uint32_t h, Index first, Index idle) {
                  const Hinge hinge = h == kIdle ? Hinge{idle, idle, idle, idle} : topology.hinges[h];
                  const Stencil s = h == kIdle ? Stencil{} : stencil(mesh, hinge);
                  if (pack < inside)
                    put(hinge, s, fabric.bend_n_m, first, k, out.inside[pack]);
                  else
                    put(hinge, s, fabric.bend_n_m, first, k, out.across[pack - inside]);
                });
  return out;
}

void solve_bend_block(BendConstraints& c, std::size_t block, float inverse_h2, Patch& patch) {
  if (c.inside.empty()) return;
  solve_packs(c.schedule.inside(std::span(c.inside), block), c.yarn, inverse_h2, patch.at);
}

void solve_bend_across(const engine::Context& context, BendConstraints& c, float inverse_h2, Particles& p) {
  for_each_across(context, c.schedule, [&](std::size_t begin, std::size_t end) {
    solve_packs(c.schedule.across(std::span(c.across), begin, end), c.yarn, inverse_h2, p.point.data());
  });
}

double bend_energy(const engine::Context& context, const BendConstraints& c, const Particles& p) {
  if (c.schedule.packs() == 0) return 0.0;
  const std::size_t size = block_size(p.count());
  const double inside = engine::ordered_reduce(
      context, c.schedule.blocks(), few_blocks(c.schedule.blocks()), 0.0,
      [&](std::size_t begin, std::size_t end) {
        double sum = 0.0;
        for (std::size_t b = begin; b < end; ++b)
          sum += energy_of_packs(c.schedule.inside(std::span(c.inside), b), c.yarn, &p.point[b * size]);
        return sum;
      },
      std::plus<>());
  return inside + engine::ordered_reduce(
                      context, c.across.size(), reduce_grain(c.across.size()), 0.0,
                      [&](std::size_t begin, std::size_t end) {
                        return energy_of_packs(std::span(c.across).subspan(begin, end - begin), c.yarn,
                                               p.point.data());
                      },
                      std::plus<>());
}

}  // namespace bodice::cloth
