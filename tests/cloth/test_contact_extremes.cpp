// Contact where a start, a step or a number of vertices is extreme: frames stay finite and bounded. Oracles
// are closest points of the ellipsoids and crossings counted without the solver. test_face_contact.cpp has
// the extremes of thickness and of faces.
#include "layer_fixtures.hpp"

using namespace bodice;
using namespace bodice_test;

TEST_CASE("contact extremes: a tube that begins wholly inside a trunk comes out, and its frames stay cheap") {
  const std::vector<geometry::Ellipsoid> trunk = {ellipsoid(Vec3(0, 1, 0), Vec3(0.15, 0.5, 0.12))};
  const collision::Collider body = collider_of(trunk);
  TriMesh mesh = tube(1.0, 0.8, 1.2, 40, 24);
  for (Vec3& p : mesh.positions) p = Vec3(0.75 * 0.15 * p.x(), p.y(), 0.75 * 0.12 * p.z());
  cloth::SolverOptions how = layered(true);
  how.environment.gravity_m_s2 = Vec3::Zero();
  cloth::Solver solver = make_solver(mesh, {}, cotton(), how);
  for (int frame = 0; frame < 45; ++frame) {  // longer than a particle is quiet before it sleeps
    CAPTURE(frame);
    const cloth::FrameReport report = solver.step({}, body, kFrame_s);
    REQUIRE(report.finite);
    // Constraints bring many parts together before contact puts them back. The number of listed pairs stays
    // bounded.
    CHECK(report.layers.pairs < 25 * solver.particles());
    if (frame > 0) CHECK((report.limits & cloth::kSpeedClamped) == 0);
    const std::vector<Vec3> at = positions(solver, mesh.positions.size());
    // Cloth comes out at a meter a second: the 37 mm that it begins inside take more than two frames.
    CHECK(nearest(trunk, at, mesh.triangles, 2) > (frame < 2 ? -0.041 + 0.017 * (frame + 1) : 0.0));
    if (frame % 11 == 0) CHECK(crossings(mesh, at) == 0);
  }
}

TEST_CASE("contact extremes: a step of 0 s moves nothing and still counts the layers that cross") {
  const collision::Collider body = ellipsoid_body(Vec3(0, -5, 0), Vec3::Constant(0.1));
  TriMesh mesh = sheet(8, 8, 0.2, 0.2, Vec3::Zero());
  TriMesh other = sheet(8, 8, 0.2, 0.2, Vec3(0.01, 0, 0.01));
  for (Vec3& p : other.positions) p.y() = 0.02 - 0.2 * p.x();
  append(other, mesh);
  cloth::Solver solver = make_solver(mesh, {}, cotton(), layered(true));
  const std::size_t crossing = solver.step({}, body, kFrame_s).layers.crossing;
  CHECK(crossing > 0);
  const std::uint64_t before = solver.hash();
  const cloth::FrameReport report = solver.step({}, body, 0.0);
  CHECK(solver.hash() == before);
  CHECK(report.substeps == 0);
  CHECK(report.layers.crossing == crossing);
}

TEST_CASE("contact extremes: a sheet of 200,000 vertices lies on a ball") {
  const std::vector<geometry::Ellipsoid> ball = {ellipsoid(Vec3(0, 1, 0), Vec3::Constant(0.2))};
  const collision::Collider body = collider_of(ball);
  const TriMesh mesh = sheet(447, 447, 0.8, 0.8, Vec3(-0.4, 1.2 + kThickness_m, -0.4));
  REQUIRE(mesh.positions.size() > 200'000);
  cloth::SolverOptions how = layered(true);
  how.substeps = 2;
  cloth::Solver solver = make_solver(mesh, {}, cotton(), how);
  CHECK(solver.particles() == mesh.positions.size());
  const cloth::FrameReport report = solver.step({}, body, kFrame_s);
  CHECK(report.finite);
  CHECK(report.contacts.contacts + report.faces.contacts > 0);
  const std::vector<Vec3> at = positions(solver, mesh.positions.size());
  double least_m = 1.0, farthest_m = 0.0;
  for (std::size_t v = 0; v < at.size(); ++v) {
    least_m = std::min(least_m, (at[v] - ball.front().center).norm() - 0.2);
    farthest_m = std::max(farthest_m, (at[v] - mesh.positions[v]).norm());
  }
  CHECK(least_m > kThickness_m - kSag_m);
  CHECK(farthest_m < 0.5 * 9.81 * kFrame_s * kFrame_s * 2.0);
}
