// A proof of triangles holds at every point of them.
#include <doctest/doctest.h>

#include "face_fixtures.hpp"

using namespace bodice;
using namespace bodice_test;

TEST_CASE(
    "face certificate: on a swinging limb a proof holds at every point; without contact there is none") {
  for (const bool on : {true, false}) {
    CAPTURE(on);
    cloth::SolverOptions how = options(on);
    how.certify_m = kCertified_m;
    Sleeve sleeve(how);
    double worst = 1.0, angle = 0.0;
    std::size_t open = 0, samples = 0;
    for (int frame = 0; frame < 60; ++frame) {
      angle += 2.0 * std::numbers::pi * kFrame_s * std::cos(0.1 * frame);
      sleeve.turn(angle);
      const cloth::FrameReport report = sleeve.solver->step({}, sleeve.body, kFrame_s);
      open += report.faces.proof.open, samples += report.faces.proof.samples;
      worst = std::min(worst, sleeve.nearest_now());
    }
    if (on) {
      CHECK(open == 0);
      CHECK(samples > 60 * sleeve.mesh.triangles.size());
      CHECK(worst > -kCertified_m - 1e-6);  // rounding of floats
    } else {
      CHECK(samples == 0);
      CHECK(worst < -2e-3);
    }
  }
}

TEST_CASE("face certificate: a fingertip that rises between samples does not come through the cloth") {
  cloth::SolverOptions how = options(true);
  how.certify_m = kCertified_m;
  std::vector<geometry::Ellipsoid> tip = {ellipsoid(Vec3(0, 0.99, 0), Vec3::Constant(0.008))};
  collision::Collider body = collider_of(tip);
  const TriMesh mesh = sheet(10, 10, 0.6, 0.6, Vec3(-0.28, 1.0, -0.28));
  std::vector<Index> rim;
  for (Index v = 0; v < 121; ++v)
    if (v % 11 == 0 || v % 11 == 10 || v < 11 || v >= 110) rim.push_back(v);
  cloth::Solver solver = make_solver(mesh, rim, cotton(), how);
  for (int frame = 0; frame < 30; ++frame) {
    tip[0].center.y() += 0.001;
    body.move_to(tip, kFrame_s);
    CHECK(solver.step({}, body, kFrame_s).faces.proof.open == 0);
    CHECK(nearest(tip, positions(solver, mesh.positions.size()), mesh.triangles, 60) > -kCertified_m - 1e-6);
  }
}

TEST_CASE("face certificate: a triangle with pinned corners that cuts a limb has no proof") {
  // All corners are pins, so that nothing can be pushed.
  const std::vector<geometry::Ellipsoid> ball = {ellipsoid(Vec3(0.1, 1, 0.1), Vec3::Constant(0.02))};
  const collision::Collider body = collider_of(ball);
  const TriMesh mesh = sheet(1, 1, 0.3, 0.3, Vec3(0, 1, 0));
  cloth::SolverOptions how = options(true);
  how.certify_m = kCertified_m;
  cloth::Solver solver = make_solver(mesh, {0, 1, 2, 3}, cotton(), how);
  CHECK(solver.step({}, body, kFrame_s).faces.proof.open == 1);
}
