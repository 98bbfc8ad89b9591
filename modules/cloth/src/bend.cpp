// Based on: Miklos Bergou, Max Wardetzky, David Harmon, Denis Zorin, Eitan Grinspun. A Quadratic Bending
// Model for Inextensible Surfaces. 2006. - eq. (3), the cotangent stencil K of a hinge. Differs: the
// stencil's vector K x is as long as edge * angle and lies along the hinge's normal n under isometry, so the
// constraint is the signed number n . K x, which keeps a curved rest shape and costs one normal; its gradient
// holds n fixed. The energy is B (K x)^2 / (2 A) with A the area of both triangles: a strip of width e bent
// by the angle t at folds h apart stores B t^2 e / (2 h), and e h = A.
#include "bend.hpp"

#include <algorithm>
#include <cmath>

#include <bodice/cloth/coloring.hpp>

#include "pack.hpp"

namespace bodice::cloth {
namespace {

// A sliver's cotangent beyond this (0.06 degrees) would only put weights of 1e3 into floats.
constexpr double kMaxCotangent = 1e3;

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

// n . K x - rest and the unit normal n; n is zero where the hinge is folded shut.
template <int kLanes>
void measure(const BendConstraints& c, std::size_t first, const Particles& p, Lanes<kLanes>& value,
             Lanes<kLanes> (&n)[3]) {
  Lanes<kLanes> at[4][3];
  for (int q = 0; q < 4; ++q) {
    const Index* corner = &c.corner[static_cast<std::size_t>(q)][first];
    for (int k = 0; k < kLanes; ++k) at[q][0][k] = p.x[corner[k]];
    for (int k = 0; k < kLanes; ++k) at[q][1][k] = p.y[corner[k]];
    for (int k = 0; k < kLanes; ++k) at[q][2][k] = p.z[corner[k]];
  }
  const float *k1 = &c.k[1][first], *k2 = &c.k[2][first], *k3 = &c.k[3][first];
  for (int k = 0; k < kLanes; ++k) {
    // Differences to the first corner: the weights sum to zero, and small numbers keep their digits.
    const float ex = at[1][0][k] - at[0][0][k], ey = at[1][1][k] - at[0][1][k],
                ez = at[1][2][k] - at[0][2][k];
    const float cx = at[2][0][k] - at[0][0][k], cy = at[2][1][k] - at[0][1][k],
                cz = at[2][2][k] - at[0][2][k];
    const float dx = at[3][0][k] - at[0][0][k], dy = at[3][1][k] - at[0][1][k],
                dz = at[3][2][k] - at[0][2][k];
    const float fx = cx - dx, fy = cy - dy, fz = cz - dz;
    const float nx = ey * fz - ez * fy, ny = ez * fx - ex * fz, nz = ex * fy - ey * fx;
    const float scale = 1.0f / std::sqrt(nx * nx + ny * ny + nz * nz + kTinyLength2);
    n[0][k] = nx * scale, n[1][k] = ny * scale, n[2][k] = nz * scale;
    const float bx = k1[k] * ex + k2[k] * cx + k3[k] * dx;
    const float by = k1[k] * ey + k2[k] * cy + k3[k] * dy;
    const float bz = k1[k] * ez + k2[k] * cz + k3[k] * dz;
    value[k] = n[0][k] * bx + n[1][k] * by + n[2][k] * bz - c.rest_m[first + k];
  }
}

template <int kLanes>
void solve_pack(const BendConstraints& c, std::size_t first, float inverse_h2, Particles& p) {
  Lanes<kLanes> value, n[3], w[4];
  measure(c, first, p, value, n);
  for (int k = 0; k < kLanes; ++k) {
    float weight = c.compliance[first + k] * inverse_h2 + kTinyWeight;
    for (int q = 0; q < 4; ++q) {
      const auto corner = static_cast<std::size_t>(q);
      w[corner][k] = p.weight[c.corner[corner][first + k]];
      weight += w[corner][k] * c.k[corner][first + k] * c.k[corner][first + k];
    }
    value[k] = -value[k] / weight;
  }
  for (int q = 0; q < 4; ++q) {
    const auto corner = static_cast<std::size_t>(q);
    for (int k = 0; k < kLanes; ++k) {
      const Index i = c.corner[corner][first + k];
      const float move = value[k] * w[corner][k] * c.k[corner][first + k];
      p.x[i] += move * n[0][k], p.y[i] += move * n[1][k], p.z[i] += move * n[2][k];
    }
  }
}

}  // namespace

BendConstraints make_bend(const geometry::TriMesh& mesh, const Topology& topology, double bend_n_m,
                          const Particles& particles) {
  BendConstraints out;
  if (bend_n_m <= 0.0) return out;
  std::vector<Index> corners;
  for (const Hinge& h : topology.hinges) corners.insert(corners.end(), {h.a, h.b, h.c, h.d});
  const Coloring coloring = color(corners, 4, particles.count());
  out.color_begin = coloring.begin;
  for (const std::uint32_t h : coloring.order) {
    const Stencil s = stencil(mesh, topology.hinges[h]);
    for (std::size_t q = 0; q < 4; ++q) {
      const Index i = corners[4 * h + q];
      out.corner[q].push_back(i);
      out.k[q].push_back(static_cast<float>(s.k[q]));
    }
    out.rest_m.push_back(static_cast<float>(s.rest));
    out.compliance.push_back(static_cast<float>(s.area / bend_n_m));
  }
  return out;
}

void solve_bend(const engine::Context& context, const BendConstraints& constraints, float inverse_h2,
                Particles& particles) {
  for_each_pack(context, constraints.color_begin, [&](std::size_t first, auto lanes) {
    solve_pack<decltype(lanes)::value>(constraints, first, inverse_h2, particles);
  });
}

double bend_energy(const BendConstraints& constraints, const Particles& particles) {
  double energy = 0.0;
  for (std::size_t h = 0; h < constraints.count(); ++h) {
    Lanes<1> value, n[3];
    measure(constraints, h, particles, value, n);
    energy += 0.5 * static_cast<double>(value[0]) * static_cast<double>(value[0]) /
              static_cast<double>(constraints.compliance[h]);
  }
  return energy;
}

}  // namespace bodice::cloth
