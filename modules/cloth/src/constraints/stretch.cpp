// Based on: Miles Macklin, Matthias Mueller, Nuttapong Chentanez. XPBD: Position-Based Simulation of
// Compliant Constrained Dynamics. 2016. - eq. (18)
// Based on: Miles Macklin, Kier Storey, Michelle Lu, Pierre Terdiman, Nuttapong Chentanez, Stefan Jeschke,
// Matthias Mueller. Small Steps in Physics Simulation. 2019.
// Based on: Allen Van Gelder. Approximate Simulation of Elastic Membranes by Triangulated Spring Meshes.
// 1998.
// - eq. (20) with zero Poisson ratio (the stiffness of an edge)
// Differs: with one sweep a substep the multiplier starts at zero and is not stored. The diagonal of a quad
// has the shear modulus. Beyond the strain limit an edge is rigid.
#include "constraints/stretch.hpp"

#include <algorithm>
#include <cmath>

#include <bodice/engine/parallel.hpp>

#include "base/tolerances.hpp"
#include "constraints/kernels.hpp"

namespace bodice::inline v0_1::cloth {
namespace {

// Longer substeps make more sweeps over a block, which is in the cache already; iterations of the solver
// shorten them by the root of their number. The second sweep lowers the excess length of hanging cloth by a
// quarter. In the shortest substeps gravity moves a particle by a few units of rounding, and another
// correction loses more to rounding than it gains.
constexpr float kWorthTwoSweeps_s = 3e-4f, kWorthThreeSweeps_s = 1.5e-3f;

int sweeps_of_block(float inverse_h2) {
  const auto longer_than = [&](float h) { return inverse_h2 * h * h < 1.0f; };
  return longer_than(kWorthThreeSweeps_s) ? 3 : longer_than(kWorthTwoSweeps_s) ? 2 : 1;
}

// The stiffness of an edge, newtons a meter of elongation. That of a strip of length l and width w is E w /
// l, and the triangles of an edge have the area l w. In a quad with the shear angle g, a diagonal of length l
// has the strain g A / l^2, and the quad stores G g^2 A / 2; hence k = G l^2 / A.
double edge_stiffness(const Edge& edge, double length, const Fabric& fabric) {
  const double shape = edge.area_m2 / (length * length);
  return edge.diagonal ? fabric.shear_n_m / shape : fabric.stretch_n_m * shape;
}

template <class Id>
void put(const Edge& edge, double length, double stiffness, Index first, std::size_t k, EdgePack<Id>& pack) {
  pack.a[k] = static_cast<Id>(edge.a - first), pack.b[k] = static_cast<Id>(edge.b - first);
  pack.rest_m[k] = static_cast<float>(length);
  pack.compliance[k] = static_cast<float>(1.0 / std::max(stiffness, 1e-9));
}

Strain add(const Strain& l, const Strain& r) {
  return {l.energy_j + r.energy_j, std::max(l.longest, r.longest)};
}

/// Raises the largest strains of the particles of these packs. `most[0]` belongs to the particle from which
/// the packs' indices count.
template <class Id>
void raise_in_packs(std::span<const EdgePack<Id>> packs, std::span<const float> strain, float above,
                    std::span<float> most) {
  for (std::size_t slot = 0; slot < strain.size(); ++slot) {
    if (!(strain[slot] > above)) continue;  // idle slots have a strain of 0
    const EdgePack<Id>& pack = packs[slot / kPack];
    for (const Id end : {pack.a[slot % kPack], pack.b[slot % kPack]})
      most[end] = std::max(most[end], strain[slot]);
  }
}

}  // namespace

StretchConstraints make_stretch(const geometry::TriMesh& mesh, const Topology& topology, const Fabric& fabric,
                                const Particles& particles) {
  std::vector<Index> ends;
  for (const Edge& edge : topology.edges) ends.push_back(edge.a), ends.push_back(edge.b);
  StretchConstraints out;
  out.schedule = make_schedule(ends, 2, particles.count());
  out.edges = topology.edges.size();
  out.longest = static_cast<float>(1.0 + fabric.max_stretch);
  const std::size_t inside = out.schedule.packs_inside();
  out.inside.resize(inside), out.across.resize(out.schedule.packs() - inside);
  for_each_slot(out.schedule, particles.count(),
                [&](std::size_t pack, std::size_t k, std::uint32_t e, Index first, Index idle) {
                  const Edge edge = e == kIdle ? Edge{idle, idle, 0.0, false} : topology.edges[e];
                  const double length =
                      e == kIdle ? 0.0 : (mesh.positions[edge.a] - mesh.positions[edge.b]).norm();
                  const double stiffness = e == kIdle ? 1.0 : edge_stiffness(edge, length, fabric);
                  if (pack < inside)
                    put(edge, length, stiffness, first, k, out.inside[pack]);
                  else
                    put(edge, length, stiffness, first, k, out.across[pack - inside]);
                });
  return out;
}

void solve_stretch_block(const StretchConstraints& c, std::size_t block, float inverse_h2, Patch& patch) {
  const int sweeps = sweeps_of_block(inverse_h2);
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    solve_packs(c.schedule.inside(std::span(c.inside), block), c.longest,
                static_cast<float>(sweeps) * inverse_h2, patch.at);
  }
}

void solve_stretch_across(const engine::Context& context, const StretchConstraints& c, float inverse_h2,
                          Particles& p) {
  for_each_across(context, c.schedule, [&](std::size_t begin, std::size_t end) {
    solve_packs(c.schedule.across(std::span(c.across), begin, end), c.longest, inverse_h2, p.point.data());
  });
}

Strain measure_stretch(const engine::Context& context, const StretchConstraints& c, const Particles& p,
                       std::span<float> strain) {
  const Schedule& schedule = c.schedule;
  const std::size_t size = block_size(p.count()), first = schedule.packs_inside();
  const Strain inside = engine::ordered_reduce(
      context, schedule.blocks(), few_blocks(schedule.blocks()), Strain{},
      [&](std::size_t begin, std::size_t end) {
        Strain sum;
        for (std::size_t b = begin; b < end; ++b)
          sum = add(sum, measure_packs(schedule.inside(std::span(c.inside), b), &p.point[b * size],
                                       &strain[kPack * schedule.block_begin[b]]));
        return sum;
      },
      add);
  const Strain across = engine::ordered_reduce(
      context, c.across.size(), reduce_grain(c.across.size()), Strain{},
      [&](std::size_t begin, std::size_t end) {
        return measure_packs(std::span(c.across).subspan(begin, end - begin), p.point.data(),
                             &strain[kPack * (first + begin)]);
      },
      add);
  return add(inside, across);
}

void raise_to_strain(const StretchConstraints& c, std::span<const float> strain, float above,
                     std::span<float> most) {
  const Schedule& schedule = c.schedule;
  const std::size_t size = block_size(most.size()), first = kPack * schedule.packs_inside();
  for (std::size_t b = 0; b < schedule.blocks(); ++b) {
    const auto packs = schedule.inside(std::span(c.inside), b);
    raise_in_packs(packs, strain.subspan(kPack * schedule.block_begin[b], kPack * packs.size()), above,
                   most.subspan(b * size));
  }
  raise_in_packs(std::span(c.across), strain.subspan(first), above, most);
}

}  // namespace bodice::cloth
