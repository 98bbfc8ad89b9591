// Edges and triangles on bodies of known shape. The oracle is the closest point of the ellipsoids in double
// precision, at a lattice of points over each triangle.
#pragma once

#include <numbers>
#include <optional>
#include <span>

#include "fixtures.hpp"

namespace bodice_test {

namespace cloth = bodice::cloth;
namespace collision = bodice::collision;
namespace geometry = bodice::geometry;
namespace proxy = bodice::proxy;

inline constexpr double kThickness_m = 1.5e-3;
/// How much nearer than the thickness a point between samples may be: a quarter of the thickness, the error
/// that face contact allows.
inline constexpr double kSag_m = 0.25 * kThickness_m;

/// Depth that no point may exceed in the tests of proofs.
inline constexpr double kCertified_m = 0.1e-3;

inline cloth::SolverOptions options(bool face_contact) {
  cloth::SolverOptions o;
  o.thickness_m = kThickness_m;
  o.face_contact = face_contact;
  return o;
}

inline double distance(std::span<const geometry::Ellipsoid> body, const Vec3& p) {
  double least = 1e9;
  for (const geometry::Ellipsoid& e : body)
    least = std::min(least, geometry::closest_point(e, p).signed_distance);
  return least;
}

/// The least distance of any point of the triangles from the body, on a lattice with `cuts` cuts an edge.
inline double nearest(std::span<const geometry::Ellipsoid> body, const std::vector<Vec3>& at,
                      const std::vector<geometry::Triangle>& triangles, int cuts = 24) {
  double least = 1e9;
  for (const auto& [a, b, c] : triangles)
    for (int i = 0; i <= cuts; ++i)
      for (int j = 0; i + j <= cuts; ++j) {
        const double u = static_cast<double>(i) / cuts, v = static_cast<double>(j) / cuts;
        least = std::min(least, distance(body, (1.0 - u - v) * at[a] + u * at[b] + v * at[c]));
      }
  return least;
}

/// A tube about y around a limb, with few segments.
inline TriMesh tube(double radius, double low, double high, int around, int rows) {
  TriMesh mesh;
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i < around; ++i) {
      const double angle = 2.0 * std::numbers::pi * (i + 0.5 * (j % 2)) / around;
      mesh.positions.emplace_back(radius * std::cos(angle), low + (high - low) * j / rows,
                                  -radius * std::sin(angle));
    }
  const auto n = static_cast<Index>(around);
  for (Index j = 0; j < static_cast<Index>(rows); ++j)
    for (Index i = 0; i < n; ++i) {
      const Index a = j * n + i, b = j * n + (i + 1) % n, c = a + n, d = b + n;
      if (j % 2 == 0)
        mesh.triangles.insert(mesh.triangles.end(), {{a, b, c}, {b, d, c}});
      else
        mesh.triangles.insert(mesh.triangles.end(), {{a, b, d}, {a, d, c}});
    }
  return mesh;
}

inline collision::Collider collider_of(std::span<const geometry::Ellipsoid> shapes) {
  proxy::BodyProxy::Data data;
  data.stature_m = 1.7;
  for (const geometry::Ellipsoid& shape : shapes) {
    proxy::ProxyEllipsoid e;
    e.shape = shape;
    data.ellipsoids.push_back(e);
  }
  return collision::Collider(*proxy::BodyProxy::make(std::move(data)));
}

inline geometry::Ellipsoid ellipsoid(const Vec3& center, const Vec3& radii) {
  return {center, geometry::Mat3::Identity(), radii};
}

/// A tight sleeve of long edges on a limb: its particles lie on the skin, and its edges cut 4 mm deep. It is
/// held at its upper rim, which is wide.
struct Sleeve {
  static constexpr Index kAround = 8, kRows = 5;

  std::vector<geometry::Ellipsoid> limb = {ellipsoid(Vec3(0, 1, 0), Vec3(0.05, 0.6, 0.05))};
  collision::Collider body = collider_of(limb);
  TriMesh mesh = tube(0.0515, 0.9, 1.1, kAround, kRows);
  std::vector<Vec3> rim;
  std::optional<cloth::Solver> solver;

  explicit Sleeve(const cloth::SolverOptions& how) {
    std::vector<Index> held;
    for (Index v = kAround * kRows; v < kAround * (kRows + 1); ++v) {
      mesh.positions[v] = mesh.positions[v].cwiseProduct(Vec3(1.2, 1.0, 1.2));
      held.push_back(v);
      rim.push_back(mesh.positions[v]);
    }
    solver.emplace(make_solver(mesh, held, cotton(), how));
  }
  explicit Sleeve(bool face_contact) : Sleeve(options(face_contact)) {}
  /// Turns limb and rim about z, by an angle from the start.
  void turn(double angle) {
    const geometry::Mat3 turned = Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix();
    limb.front().axes = turned;
    body.move_to(limb, kFrame_s);
    std::vector<Vec3> now = rim;
    for (Vec3& p : now) p = limb.front().center + turned * (p - limb.front().center);
    solver->move_pins(now);
  }
  double nearest_now() { return nearest(limb, positions(*solver, mesh.positions.size()), mesh.triangles); }
};

}  // namespace bodice_test
