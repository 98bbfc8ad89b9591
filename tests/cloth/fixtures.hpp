// Small garments and bodies with known truth.
#pragma once

#include <cmath>
#include <vector>

#include <doctest/doctest.h>

#include <bodice/cloth/solver.hpp>

namespace bodice_test {

using bodice::geometry::Index;
using bodice::geometry::TriMesh;
using bodice::geometry::Vec3;

inline constexpr double kFrame_s = 1.0 / 60.0;

/// A flat sheet of nx * nz quads, each cut in two with alternating diagonals, from `corner` along x and z.
inline TriMesh sheet(int nx, int nz, double width, double depth, const Vec3& corner) {
  TriMesh mesh;
  for (int j = 0; j <= nz; ++j) {
    for (int i = 0; i <= nx; ++i)
      mesh.positions.push_back(corner + Vec3(width * i / nx, 0.0, depth * j / nz));
  }
  for (int j = 0; j < nz; ++j) {
    for (int i = 0; i < nx; ++i) {
      const Index a = static_cast<Index>(j * (nx + 1) + i), b = a + 1, c = a + static_cast<Index>(nx) + 1,
                  d = c + 1;
      if ((i + j) % 2 == 0) {
        mesh.triangles.insert(mesh.triangles.end(), {{a, c, b}, {b, c, d}});
      } else {
        mesh.triangles.insert(mesh.triangles.end(), {{a, c, d}, {a, d, b}});
      }
    }
  }
  return mesh;
}

/// A body of one ellipsoid with the given radii.
inline bodice::collision::Collider ellipsoid_body(const Vec3& center, const Vec3& radii) {
  bodice::proxy::BodyProxy::Data data;
  data.stature_m = 2.0 * radii.maxCoeff();
  bodice::proxy::ProxyEllipsoid e;
  e.shape.center = center;
  e.shape.radii = radii;
  data.ellipsoids.push_back(e);
  return bodice::collision::Collider(*bodice::proxy::BodyProxy::make(std::move(data)));
}

inline bodice::cloth::Fabric cotton() {
  return *bodice::cloth::find_fabric("cotton");
}

/// Options without air and self-contact, as closed forms assume.
inline bodice::cloth::SolverOptions vacuum() {
  bodice::cloth::SolverOptions options;
  options.environment.air_density_kg_m3 = 0.0;
  options.self_collision = false;
  return options;
}

inline bodice::cloth::Solver make_solver(const TriMesh& mesh, const std::vector<Index>& pins,
                                         const bodice::cloth::Fabric& fabric,
                                         const bodice::cloth::SolverOptions& options) {
  auto made = bodice::cloth::Solver::make(mesh, pins, fabric, options);
  REQUIRE(made.ok());
  return std::move(*made);
}

inline std::vector<Vec3> positions(const bodice::cloth::Solver& solver, std::size_t vertices) {
  std::vector<Vec3> out(vertices);
  solver.positions(out);
  return out;
}

}  // namespace bodice_test
