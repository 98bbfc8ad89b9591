// Closed forms that any cloth solver has to reproduce.
#include <doctest/doctest.h>

#include <algorithm>
#include <numbers>

#include "fixtures.hpp"

using namespace bodice;
using namespace bodice_test;

namespace {

// The period of a triangle that swings freely about its pinned edge along x: its third corner is a point
// pendulum.
double measured_period(double length, double start_angle, double step_s) {
  TriMesh mesh;
  mesh.positions = {Vec3(-0.1, 0, 0), Vec3(0.1, 0, 0),
                    length * Vec3(0, -std::cos(start_angle), std::sin(start_angle))};
  mesh.triangles = {{0, 1, 2}};
  cloth::Fabric fabric = cotton();
  fabric.damping_per_s = 0.0;
  cloth::Solver solver = make_solver(mesh, {0, 1}, fabric, vacuum());
  const engine::Context context;
  std::vector<double> crossings;
  double before = mesh.positions[2][2];
  for (int frame = 1; frame < 8000 && crossings.size() < 3; ++frame) {
    solver.step(context, step_s);
    const double now = positions(solver, 3)[2][2];
    if (before > 0.0 && now <= 0.0) crossings.push_back(step_s * (frame - now / (now - before)));
    before = now;
  }
  REQUIRE(crossings.size() == 3);
  return 0.5 * (crossings[2] - crossings[0]);
}

}  // namespace

TEST_CASE("known answers: a swinging triangle has the period of a point pendulum") {
  for (const double length : {0.3, 1.0}) {
    constexpr double kAngle = 0.2;
    // The first terms of the elliptic integral for a finite amplitude.
    const double expected =
        2.0 * std::numbers::pi * std::sqrt(length / 9.81) * (1.0 + kAngle * kAngle / 16.0);
    for (const double step_s : {1e-3, 1e-2, kFrame_s})
      CHECK(measured_period(length, kAngle, step_s) == doctest::Approx(expected).epsilon(0.02));
  }
}

TEST_CASE("known answers: a sheet that hangs from two opposite edges has the shape of a catenary") {
  // The strip is 1 m long and hangs from edges 0.8 m apart: y = a cosh(x / a) with 2 a sinh(0.4 / a) = 1.
  double low = 0.1, high = 10.0;
  for (int i = 0; i < 100; ++i) {
    const double a = 0.5 * (low + high);
    (2.0 * a * std::sinh(0.4 / a) > 1.0 ? low : high) = a;
  }
  const double sag = low * (std::cosh(0.4 / low) - 1.0);

  constexpr int kQuads = 24;
  TriMesh mesh = sheet(kQuads, 4, 1.0, 0.16, Vec3::Zero());
  std::vector<Index> pins;
  for (Index v = 0; v < mesh.positions.size(); ++v) {
    if (v % (kQuads + 1) == 0 || v % (kQuads + 1) == kQuads) pins.push_back(v);
  }
  cloth::Fabric fabric = cotton();
  fabric.damping_per_s = 2.0;
  cloth::SolverOptions options = vacuum();
  options.substeps = 16;
  cloth::Solver solver = make_solver(mesh, pins, fabric, options);
  const engine::Context context;
  std::vector<Vec3> ends;
  for (const Index p : pins) ends.push_back(mesh.positions[p]);
  // The ends move toward each other for two seconds, then the strip comes to rest.
  for (int frame = 0; frame < 600; ++frame) {
    const double t = std::min(1.0, frame / 120.0);
    for (std::size_t i = 0; i < pins.size(); ++i) {
      const double x = mesh.positions[pins[i]][0];
      ends[i][0] = x + t * 0.1 * (x < 0.5 ? 1.0 : -1.0);
    }
    solver.move_pins(ends);
    solver.step(context, kFrame_s);
  }
  double lowest = 0.0;
  for (const Vec3& p : positions(solver, mesh.positions.size())) lowest = std::min(lowest, p[1]);
  CHECK(-lowest == doctest::Approx(sag).epsilon(0.02));
}

// A sweep transmits a pull over a few of the hundred edges only, so that this checks the coarse levels.
TEST_CASE("known answers: a released ribbon is never longer than its strain limit allows") {
  TriMesh mesh = sheet(2, 100, 0.02, 1.0, Vec3::Zero());
  for (Vec3& p : mesh.positions) p = Vec3(p.x(), -p.z(), 0.0);
  for (const int substeps : {4, 8, 16}) {
    CAPTURE(substeps);
    cloth::SolverOptions options;
    options.substeps = substeps;
    cloth::Solver solver = make_solver(mesh, {0, 1, 2}, cotton(), options);
    for (int frame = 0; frame < 60; ++frame) {
      solver.step({}, kFrame_s);
      CHECK(-positions(solver, mesh.positions.size()).back().y() < 1.0 + cotton().max_stretch);
    }
  }
}

TEST_CASE(
    "known answers: a released fold keeps the angle that friction holds, and no angle without friction") {
  // For two equilateral triangles and a moment m a meter of fold, B t / h = m with h the area over the edge.
  constexpr double kSide = 0.01, kFriction_n = 2.0e-4, kBend_n_m = 8.0e-6;
  const double height = kSide * std::sqrt(0.75);
  TriMesh mesh;
  mesh.positions = {Vec3(0, 0, 0), Vec3(0, 0, kSide), Vec3(-height, 0, kSide / 2),
                    Vec3(height, 0, kSide / 2)};
  mesh.triangles = {{0, 1, 2}, {1, 0, 3}};
  auto kept_rad = [&](double friction_n) {
    cloth::Fabric fabric = cotton();
    fabric.bend_n_m = kBend_n_m;
    fabric.bend_friction_n = friction_n;
    fabric.damping_per_s = 1000.0;  // the fold creeps to its final angle
    cloth::SolverOptions options = vacuum();
    options.substeps = 16;
    options.environment.gravity_m_s2 *= 50.0;  // bends the fold far beyond that angle
    cloth::Solver solver = make_solver(mesh, {0, 1, 2}, fabric, options);
    const engine::Context context;
    for (int frame = 0; frame < 60; ++frame) solver.step(context, kFrame_s);
    cloth::Environment weightless = options.environment;
    weightless.gravity_m_s2 = Vec3::Zero();
    REQUIRE(solver.set_environment(weightless).ok());
    for (int frame = 0; frame < 60; ++frame) solver.step(context, kFrame_s);
    const Vec3 tip = positions(solver, mesh.positions.size())[3];
    return std::atan2(-tip[1], tip[0]);
  };
  CHECK(std::abs(kept_rad(0.0)) < 0.01);
  CHECK(kept_rad(kFriction_n) == doctest::Approx(kFriction_n * height / kBend_n_m).epsilon(0.05));
}

TEST_CASE("known answers: a sheet dropped on an ellipsoid rests on its offset surface") {
  const engine::Context context;
  for (const Vec3& radii : {Vec3(0.2, 0.2, 0.2), Vec3(0.3, 0.15, 0.2)}) {
    const collision::Collider body = ellipsoid_body(Vec3(0, 1, 0), radii);
    const TriMesh mesh = sheet(40, 40, 0.8, 0.8, Vec3(-0.4, 1.0 + radii[1] + 0.02, -0.4));
    cloth::SolverOptions options;
    options.thickness_m = 0.002;
    cloth::Solver solver = make_solver(mesh, {}, cotton(), options);
    for (int frame = 0; frame < 240; ++frame) solver.step(context, body, kFrame_s);
    geometry::Ellipsoid shape{Vec3(0, 1, 0), geometry::Mat3::Identity(), radii};
    const std::vector<Vec3> rest = positions(solver, mesh.positions.size());
    double nearest = 1.0, crown = 0.0;
    for (const Vec3& p : rest) {
      const double d = geometry::closest_point(shape, p).signed_distance;
      nearest = std::min(nearest, d);
      if (std::hypot(p[0], p[2]) < 0.05) crown = std::max(crown, d);
    }
    CHECK(nearest > options.thickness_m - 1e-5);
    CHECK(crown < options.thickness_m + 1e-3);
    CHECK(crown > 0.0);
  }
}
