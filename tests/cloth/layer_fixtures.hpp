// Layers of cloth that must not pass through each other. The oracle counts triangles that cross, in double
// precision and without the solver's lists.
#pragma once

#include <functional>
#include <numbers>

#include <bodice/geometry/crossings.hpp>

#include "base/particles.hpp"
#include "face_fixtures.hpp"

namespace bodice_test {

inline std::size_t crossings(const TriMesh& mesh, const std::vector<Vec3>& at) {
  return geometry::find_crossings(at, mesh.triangles).size();
}

inline void append(const TriMesh& more, TriMesh& all) {
  const auto first = static_cast<Index>(all.positions.size());
  all.positions.insert(all.positions.end(), more.positions.begin(), more.positions.end());
  for (const auto& t : more.triangles) all.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
}

/// A grid of quads, each cut in two: `at(u, v)` for u and v from 0 to 1. With `closed` the last column is the
/// first one.
inline TriMesh surface(int columns, int rows, bool closed, const std::function<Vec3(double, double)>& at) {
  TriMesh mesh;
  const int across = closed ? columns : columns + 1;
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i < across; ++i)
      mesh.positions.push_back(at(static_cast<double>(i) / columns, static_cast<double>(j) / rows));
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const auto index = [&](int column, int row) {
        return static_cast<Index>(row * across + column % across);
      };
      const Index a = index(i, j), b = index(i + 1, j), c = index(i, j + 1), d = index(i + 1, j + 1);
      if ((i + j) % 2 == 0)
        mesh.triangles.insert(mesh.triangles.end(), {{a, c, b}, {b, c, d}});
      else
        mesh.triangles.insert(mesh.triangles.end(), {{a, c, d}, {a, d, b}});
    }
  return mesh;
}

inline std::vector<cloth::Point> points_of(const std::vector<Vec3>& positions) {
  std::vector<cloth::Point> at;
  for (const Vec3& p : positions)
    at.push_back({static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()), 0.0f});
  return at;
}

/// A strip of 2 x 4 quads. Its second half is turned about the line between the halves.
inline TriMesh folded_strip(double angle) {
  return surface(2, 4, false, [&](double u, double v) {
    const double out = std::abs(v - 0.5);
    return v < 0.5 ? Vec3(u, 0, -out) : Vec3(u, out * std::sin(angle), out * std::cos(angle));
  });
}

/// The least height of its triangles.
inline const double kStripHeight_m = 0.5 * 0.25 / std::hypot(0.5, 0.25);

inline Vec3 around(double turns, double radius, double height) {
  const double angle = 2.0 * std::numbers::pi * turns;
  return {radius * std::cos(angle), height, radius * std::sin(angle)};
}

/// A garment, a body and what moves them.
struct LayerScene {
  TriMesh mesh;
  std::vector<geometry::Ellipsoid> body;
  std::vector<Index> pins;
  std::function<Vec3(const Vec3& start, double time_s)> pin_at;
  std::function<void(double time_s, std::vector<geometry::Ellipsoid>&)> move_body;
  Vec3 velocity = Vec3::Zero();
  int frames = 60;
};

/// The outcome of a scene.
struct LayerOutcome {
  std::size_t start = 0, worst = 0, end = 0;  ///< pairs of triangles that cross
  double deepest_m = 0.0;                     ///< how deep the deepest particle was
  std::uint64_t hash = 0;
  cloth::FrameReport report;
};

inline LayerOutcome play(const LayerScene& scene, cloth::SolverOptions how, int workers = 1) {
  const auto executor = bodice::engine::make_tbb_executor(workers);
  const bodice::engine::Context context{.executor = executor.get()};
  cloth::Solver solver = make_solver(scene.mesh, scene.pins, cotton(), how);
  std::vector<geometry::Ellipsoid> body = scene.body;
  collision::Collider collider = collider_of(body);
  solver.set_velocity(scene.velocity);
  LayerOutcome out;
  out.start = crossings(scene.mesh, scene.mesh.positions);
  for (int frame = 1; frame <= scene.frames; ++frame) {
    const double time_s = frame * kFrame_s;
    if (scene.move_body) {
      scene.move_body(time_s, body);
      collider.move_to(body, kFrame_s);
    }
    if (scene.pin_at) {
      std::vector<Vec3> targets;
      for (const Index v : scene.pins) targets.push_back(scene.pin_at(scene.mesh.positions[v], time_s));
      solver.move_pins(targets);
    }
    out.report = solver.step(context, collider, kFrame_s);
    const std::vector<Vec3> at = positions(solver, scene.mesh.positions.size());
    for (const Vec3& p : at) out.deepest_m = std::max(out.deepest_m, -distance(body, p));
    if (!how.self_collision && frame % 5 != 0) continue;  // some frames suffice without self-contact
    out.end = crossings(scene.mesh, at);
    out.worst = std::max(out.worst, out.end);
  }
  out.hash = solver.hash();
  return out;
}

inline cloth::SolverOptions layered(bool self_collision) {
  cloth::SolverOptions o;
  o.thickness_m = kThickness_m;
  o.self_collision = self_collision;
  return o;
}

}  // namespace bodice_test
