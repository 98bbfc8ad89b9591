// Based on: Miles Macklin, Matthias Mueller, Nuttapong Chentanez. XPBD: Position-Based Simulation of
// Compliant Constrained Dynamics. 2016. - eq. (18); Miles Macklin et al. Small Steps in Physics Simulation.
// 2019. Stiffness of an edge: Allen Van Gelder. Approximate Simulation of Elastic Membranes by Triangulated
// Spring Meshes. 1998. - eq. (20) with zero Poisson ratio. Differs: one sweep a substep, so that the
// multiplier starts at zero and is never stored; the diagonal of a quad carries the shear modulus; beyond the
// strain limit an edge is rigid.
#include "stretch.hpp"

#include <algorithm>
#include <cmath>

#include <bodice/engine/parallel.hpp>

#include "kernels.hpp"
#include "tiny.hpp"

namespace bodice::cloth {
namespace {

// Lengths of substeps, in seconds: above it a second sweep over a block, which is in the cache already, lets
// cloth hang a quarter less too long. Below it gravity moves a particle by a few steps of its floats, and
// what a second correction rounds away is more than what it gains.
constexpr float kWorthTwoSweeps_s = 3e-4f;

// Newtons a metre of elongation. A strip of length l and width w is E w / l, and the triangles of an edge
// have the area l w. A diagonal of length l feels the shear angle g as the strain g A / l^2, the quad holds
// G g^2 A / 2, hence k = G l^2 / A.
double edge_stiffness(const Edge& edge, double length, const Fabric& fabric) {
  const double shape = edge.area_m2 / (length * length);
  return edge.diagonal ? fabric.shear_n_m / shape : fabric.stretch_n_m * shape;
}

}  // namespace

StretchConstraints make_stretch(const geometry::TriMesh& mesh, const Topology& topology, const Fabric& fabric,
                                const Particles& particles) {
  std::vector<Index> ends;
  for (const Edge& edge : topology.edges) ends.push_back(edge.a), ends.push_back(edge.b);
  StretchConstraints out;
  out.schedule = make_schedule(ends, 2, particles.count());
  for (std::size_t slot = 0; slot < out.schedule.slot.size(); ++slot) {
    const std::uint32_t e = out.schedule.slot[slot];
    const Index idle = out.schedule.idle[slot / kPack];
    const Edge edge = e == kIdle ? Edge{idle, idle, 0.0, false} : topology.edges[e];
    const double length = e == kIdle ? 0.0 : (mesh.positions[edge.a] - mesh.positions[edge.b]).norm();
    out.a.push_back(edge.a), out.b.push_back(edge.b);
    out.rest_m.push_back(static_cast<float>(length));
    out.limit_m.push_back(static_cast<float>(length * (1.0 + fabric.max_stretch)));
    const double stiffness = e == kIdle ? 1.0 : edge_stiffness(edge, length, fabric);
    out.compliance.push_back(static_cast<float>(1.0 / std::max(stiffness, 1e-9)));
  }
  out.edges = topology.edges.size();
  return out;
}

void solve_stretch_block(const StretchConstraints& c, std::size_t block, float inverse_h2, Particles& p) {
  const int sweeps = inverse_h2 * kWorthTwoSweeps_s * kWorthTwoSweeps_s < 1.0f ? 2 : 1;
  const PackRange packs = {c.schedule.block_begin[block], c.schedule.block_begin[block + 1]};
  for (int sweep = 0; sweep < sweeps; ++sweep)
    solve_stretch_packs(c, packs, static_cast<float>(sweeps) * inverse_h2, p.point.data());
}

void solve_stretch_across(const engine::Context& context, const StretchConstraints& c, float inverse_h2,
                          Particles& p) {
  for_each_across(context, c.schedule, [&](std::size_t begin, std::size_t end) {
    solve_stretch_packs(c, {begin, end}, inverse_h2, p.point.data());
  });
}

Strain measure_stretch(const engine::Context& context, const StretchConstraints& c, const Particles& p,
                       std::span<float> strain) {
  return engine::ordered_reduce(
      context, c.schedule.packs(), reduce_grain(c.schedule.packs()), Strain{},
      [&](std::size_t begin, std::size_t end) {
        return measure_stretch_packs(c, {begin, end}, p.point.data(), strain);
      },
      [](const Strain& l, const Strain& r) {
        return Strain{l.energy_j + r.energy_j, std::max(l.longest, r.longest)};
      });
}

}  // namespace bodice::cloth
