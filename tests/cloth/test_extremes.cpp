// For any input of a caller a frame ends, its result is finite and bounded, and its report states what was
// bounded.
#include <doctest/doctest.h>

#include <limits>

#include <bodice/cloth/weld.hpp>

#include "fixtures.hpp"

using namespace bodice;
using namespace bodice_test;

namespace {

/// The last frame's report, with the limits of all frames.
struct Outcome {
  cloth::FrameReport report;
  double reach = 0.0;  ///< largest distance from the start, meters
};

Outcome run(const TriMesh& mesh, const cloth::SolverOptions& options, const collision::Collider& body,
            double dt_s, int frames, const Vec3& velocity = Vec3::Zero()) {
  cloth::Solver solver = make_solver(mesh, {}, cotton(), options);
  solver.set_velocity(velocity);
  const engine::Context context;
  Outcome out;
  std::uint32_t limits = 0;
  for (int frame = 0; frame < frames; ++frame) {
    out.report = solver.step(context, body, dt_s);
    limits |= out.report.limits;
    REQUIRE(out.report.finite);
  }
  out.report.limits = limits;
  const auto now = positions(solver, mesh.positions.size());
  for (std::size_t v = 0; v < now.size(); ++v) {
    if (mesh.positions[v].allFinite()) out.reach = std::max(out.reach, (now[v] - mesh.positions[v]).norm());
  }
  return out;
}

}  // namespace

TEST_CASE("extremes: a step of 0 s changes no bit, and its report is complete") {
  const collision::Collider body = ellipsoid_body(Vec3(0, 1, 0), Vec3::Constant(0.2));
  cloth::Solver solver = make_solver(sheet(6, 6, 0.6, 0.6, Vec3(-0.3, 1.25, -0.3)), {}, cotton(), {});
  const engine::Context context;
  solver.step(context, body, 1.0 / 60.0);
  const std::uint64_t before = solver.hash();
  for (const double dt : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    const cloth::FrameReport report = solver.step(context, body, dt);
    CHECK(report.substeps == 0);
    CHECK(report.kinetic_energy_j > 0.0);
    CHECK(solver.hash() == before);
  }
}

TEST_CASE("extremes: long, short and violent frames stay finite and report what was bounded") {
  const collision::Collider body = ellipsoid_body(Vec3(0, 1, 0), Vec3::Constant(0.2));
  const TriMesh mesh = sheet(12, 12, 0.6, 0.6, Vec3(-0.3, 1.25, -0.3));
  cloth::SolverOptions options;
  CHECK(run(mesh, options, body, 1e-3, 60).reach < 0.05);
  CHECK((run(mesh, options, body, 1.0, 3).report.limits & cloth::kMoreSubsteps) != 0);
  CHECK((run(mesh, options, body, 100.0, 1).report.limits & cloth::kTimeCut) != 0);
  options.environment.gravity_m_s2 *= 100.0;
  CHECK((run(mesh, options, body, 1.0 / 60.0, 30).report.limits & cloth::kMoreSubsteps) != 0);
  options.environment.gravity_m_s2 /= 100.0;
  options.environment.wind_m_s = Vec3(100, 0, 0);
  options.environment.gust = 1.0;
  // Cloth in the air is faster than the air only by the effect of gravity.
  CHECK(run(mesh, options, body, 1.0 / 60.0, 60).reach < 200.0 + 5.0);
}

TEST_CASE("extremes: a garment thrown at the body at 50 m/s ends neither inside nor behind it") {
  const geometry::Ellipsoid shape{Vec3(0, 1, 0), geometry::Mat3::Identity(), Vec3(0.3, 0.2, 0.3)};
  const collision::Collider body = ellipsoid_body(shape.center, shape.radii);
  const TriMesh mesh = sheet(16, 16, 0.4, 0.4, Vec3(-0.2, 1.8, -0.2));
  cloth::Solver solver = make_solver(mesh, {}, cotton(), {});
  solver.set_velocity(Vec3(0, -50, 0));
  const engine::Context context;
  for (int frame = 0; frame < 10; ++frame) {
    REQUIRE(solver.step(context, body, 1.0 / 60.0).finite);
    for (const Vec3& p : positions(solver, mesh.positions.size())) {
      REQUIRE(geometry::closest_point(shape, p).signed_distance > -1e-5);
    }
  }
  for (const Vec3& p : positions(solver, mesh.positions.size())) CHECK(p[1] > 0.7);
}

TEST_CASE("extremes: small, large and far scenes drape without unresolved contacts") {
  for (const double scale : {1e-3, 1.0, 30.0}) {
    for (const double shift : {0.0, 1e4}) {
      cloth::SolverOptions options;
      options.thickness_m = 1e-3 * scale;
      const Vec3 center = Vec3(shift, scale, -shift);
      const collision::Collider body = ellipsoid_body(center, Vec3::Constant(0.2 * scale));
      const TriMesh mesh = sheet(10, 10, 0.6 * scale, 0.6 * scale, center + scale * Vec3(-0.3, 0.21, -0.3));
      const Outcome out = run(mesh, options, body, 1.0 / 60.0, 30);
      CHECK(out.report.contacts.contacts + out.report.faces.contacts > 0);  // coarse faces may carry it alone
      CHECK(out.report.contacts.unresolved == 0);
      CHECK(out.reach < 3.0 * scale);
    }
  }
}

TEST_CASE("extremes: one triangle, slivers and extreme mass ratios stay bounded") {
  const collision::Collider body = ellipsoid_body(Vec3(0, 1, 0), Vec3::Constant(0.2));
  TriMesh one;
  one.positions = {Vec3(-0.05, 1.3, 0), Vec3(0.05, 1.3, 0), Vec3(0, 1.3, 0.1)};
  one.triangles = {{0, 1, 2}};
  CHECK(run(one, {}, body, 1.0 / 60.0, 120).reach < 50.0);
  // Areas differ by a factor of 1e4; most triangles are small, so that weld() drops none.
  TriMesh mixed = one;
  for (Index k = 0; k < 6; ++k) {
    mixed.positions.insert(mixed.positions.end(),
                           {Vec3(0.0005, 1.3, 0.101 + 0.001 * k), Vec3(-0.0005, 1.3, 0.101 + 0.001 * k)});
    const Index right = 3 + 2 * k, left = right + 1;
    if (k == 0)
      mixed.triangles.push_back({2, right, left});
    else
      mixed.triangles.insert(mixed.triangles.end(), {{right - 2, right, left}, {right - 2, left, left - 2}});
  }
  REQUIRE(cloth::weld(mixed)->mesh.triangles.size() == mixed.triangles.size());
  CHECK(run(mixed, {}, body, 1.0 / 60.0, 120).report.stretch_max < 10.0);
  TriMesh sliver = one;
  sliver.positions.push_back(Vec3(0, 1.3, -1e-6));
  sliver.triangles.push_back({0, 3, 1});
  CHECK(run(sliver, {}, body, 1.0 / 60.0, 120).reach < 50.0);
}

TEST_CASE("solver options: one out of range fails with a message that names it") {
  const TriMesh mesh = sheet(1, 1, 0.1, 0.1, Vec3::Zero());
  cloth::SolverOptions options;
  options.substeps = 0;
  const auto none = cloth::Solver::make(mesh, {}, cotton(), options);
  REQUIRE_FALSE(none.ok());
  CHECK(none.error().message.find("substeps") != std::string::npos);
}
