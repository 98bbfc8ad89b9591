// Based on: Miles Macklin, Matthias Mueller, Nuttapong Chentanez. XPBD: Position-Based Simulation of
// Compliant Constrained Dynamics. 2016. - eq. (18); Miles Macklin et al. Small Steps in Physics Simulation.
// 2019. Stiffness of an edge: Allen Van Gelder. Approximate Simulation of Elastic Membranes by Triangulated
// Spring Meshes. 1998. - eq. (20) with zero Poisson ratio. Differs: one sweep a substep, so that the
// multiplier starts at zero and is never stored; the diagonal of a quad carries the shear modulus; beyond the
// strain limit an edge is rigid.
#include "stretch.hpp"

#include <algorithm>
#include <cmath>

#include <bodice/cloth/coloring.hpp>
#include <bodice/engine/parallel.hpp>

#include "pack.hpp"

namespace bodice::cloth {
namespace {

// Newtons a metre of elongation. A strip of length l and width w is E w / l, and the triangles of an edge
// have the area l w. A diagonal of length l feels the shear angle g as the strain g A / l^2, the quad holds
// G g^2 A / 2, hence k = G l^2 / A.
double edge_stiffness(const Edge& edge, double length, const Fabric& fabric) {
  const double shape = edge.area_m2 / (length * length);
  return edge.diagonal ? fabric.shear_n_m / shape : fabric.stretch_n_m * shape;
}

template <int kLanes>
void solve_pack(const StretchConstraints& c, std::size_t first, float inverse_h2, Particles& p) {
  const Index *a = &c.a[first], *b = &c.b[first];
  Lanes<kLanes> dx, dy, dz, wa, wb, scale;
  for (int k = 0; k < kLanes; ++k) {
    dx[k] = p.x[a[k]] - p.x[b[k]];
    dy[k] = p.y[a[k]] - p.y[b[k]];
    dz[k] = p.z[a[k]] - p.z[b[k]];
    wa[k] = p.weight[a[k]];
    wb[k] = p.weight[b[k]];
  }
  for (int k = 0; k < kLanes; ++k) {
    const float length = std::sqrt(dx[k] * dx[k] + dy[k] * dy[k] + dz[k] * dz[k] + kTinyLength2);
    const float w = wa[k] + wb[k];
    const float soft =
        (length - c.rest_m[first + k]) / (w + c.compliance[first + k] * inverse_h2 + kTinyWeight);
    const float hard = (length - c.limit_m[first + k]) / (w + kTinyWeight);
    scale[k] = std::max(soft, hard) / length;  // hard is above soft only beyond the limit
  }
  for (int k = 0; k < kLanes; ++k) {
    const float to_a = -scale[k] * wa[k], to_b = scale[k] * wb[k];
    p.x[a[k]] += to_a * dx[k], p.y[a[k]] += to_a * dy[k], p.z[a[k]] += to_a * dz[k];
    p.x[b[k]] += to_b * dx[k], p.y[b[k]] += to_b * dy[k], p.z[b[k]] += to_b * dz[k];
  }
}

}  // namespace

StretchConstraints make_stretch(const geometry::TriMesh& mesh, const Topology& topology, const Fabric& fabric,
                                const Particles& particles) {
  std::vector<Index> ends;
  for (const Edge& edge : topology.edges) ends.push_back(edge.a), ends.push_back(edge.b);
  const Coloring coloring = color(ends, 2, particles.count());
  StretchConstraints out;
  out.color_begin = coloring.begin;
  for (const std::uint32_t e : coloring.order) {
    const Edge& edge = topology.edges[e];
    const double length = (mesh.positions[edge.a] - mesh.positions[edge.b]).norm();
    out.a.push_back(edge.a), out.b.push_back(edge.b);
    out.rest_m.push_back(static_cast<float>(length));
    out.limit_m.push_back(static_cast<float>(length * (1.0 + fabric.max_stretch)));
    const double stiffness = edge_stiffness(edge, length, fabric);
    out.compliance.push_back(static_cast<float>(1.0 / std::max(stiffness, 1e-9)));
  }
  return out;
}

void solve_stretch(const engine::Context& context, const StretchConstraints& constraints, float inverse_h2,
                   Particles& particles) {
  for_each_pack(context, constraints.color_begin, [&](std::size_t first, auto lanes) {
    solve_pack<decltype(lanes)::value>(constraints, first, inverse_h2, particles);
  });
}

double stretch_energy(const StretchConstraints& c, const Particles& p) {
  double energy = 0.0;
  for (std::size_t e = 0; e < c.count(); ++e) {
    const float dx = p.x[c.a[e]] - p.x[c.b[e]], dy = p.y[c.a[e]] - p.y[c.b[e]],
                dz = p.z[c.a[e]] - p.z[c.b[e]];
    const double stretch = static_cast<double>(std::sqrt(dx * dx + dy * dy + dz * dz) - c.rest_m[e]);
    energy += 0.5 * stretch * stretch / static_cast<double>(c.compliance[e]);
  }
  return energy;
}

}  // namespace bodice::cloth
