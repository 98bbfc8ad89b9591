// What keeps a frame of crushed cloth bounded: stretched cloth slips on a body that moves, and single
// particles that are flung take no more substeps.
#include <doctest/doctest.h>

#include "contact/body_contact.hpp"
#include "fixtures.hpp"
#include "solver/state.hpp"

using namespace bodice;
using namespace bodice_test;

namespace {

/// A sheet of 10 quads along x with all of its particles pinned, far from the body.
cloth::State pinned_sheet(TriMesh& mesh) {
  mesh = sheet(10, 2, 0.5, 0.1, Vec3(0, 5, 0));
  std::vector<Index> all(mesh.positions.size());
  for (Index i = 0; i < all.size(); ++i) all[i] = i;
  auto state = cloth::make_state(mesh, all, cotton(), vacuum());
  REQUIRE(state.ok());
  return std::move(*state);
}

/// Displaces a particle that presses 1 mm into a ball by 0.1 mm along its surface; returns how much of that
/// is left.
double slip_left(bool moving, float grip) {
  const collision::Collider ball = ellipsoid_body(Vec3::Zero(), Vec3::Constant(0.1));
  const TriMesh quad = sheet(1, 1, 0.1, 0.1, Vec3(0, 0.1, 0));  // touches the ball with its first corner
  cloth::SolverOptions options = vacuum();
  options.face_contact = false;
  options.thickness_m = 0.0;
  auto state = cloth::make_state(quad, {}, cotton(), options);
  REQUIRE(state.ok());
  cloth::ContactState& contacts = state->contacts;
  cloth::begin_contact_frame({}, {.body = &ball, .length_s = kFrame_s}, options, state->particles, contacts);
  contacts.motion.moving = moving;
  contacts.grip.assign(quad.positions.size(), grip);
  cloth::Particles& p = state->particles;
  const Index at = state->particle_of_vertex[0];
  p.old_x = p.x, p.old_y = p.y, p.old_z = p.z;
  p.point[at].x += 1e-4f, p.point[at].y -= 1e-3f;
  cloth::resolve_body_contacts({}, &ball, options, {1e-3f, {}}, contacts, p);
  REQUIRE(contacts.touching[at]);
  return p.world(at).x();
}

}  // namespace

TEST_CASE("grip: cloth that is stretched far beyond its limit has no friction while it is") {
  TriMesh mesh;
  cloth::State state = pinned_sheet(mesh);
  std::vector<Vec3> at = mesh.positions;
  for (Vec3& p : at) p.x() *= p.x() > 0.26 ? 1.3 : 1.0;  // edges beyond the sixth column are 30 % longer
  REQUIRE(cloth::set_pin_targets(at, state.pins));
  const auto grip_of = [&](std::size_t vertex) {
    return state.contacts.grip[state.particle_of_vertex[vertex]];
  };
  geometry::Ellipsoid ball{Vec3::Zero(), geometry::Mat3::Identity(), Vec3::Constant(0.1)};
  collision::Collider body = ellipsoid_body(ball.center, ball.radii);
  const auto advance = [&] {
    ball.center.x() += 0.001;
    body.move_to(std::span(&ball, 1), kFrame_s);
    cloth::advance({}, &body, kFrame_s, state);
  };
  for (int frame = 0; frame < 2; ++frame) {  // friction is that of the strain when the last frame ended
    CHECK(grip_of(10) == 1.0f);
    advance();
  }
  CHECK(grip_of(0) == 1.0f);
  CHECK(grip_of(10) == 0.0f);
  REQUIRE(cloth::set_pin_targets(mesh.positions, state.pins));
  for (int frame = 0; frame < 2; ++frame) advance();
  for (std::size_t v = 0; v < at.size(); ++v) CHECK(grip_of(v) == 1.0f);
}

TEST_CASE("grip: substeps are doubled where that is wanted and a body that moves stretches cloth too far") {
  geometry::Ellipsoid ball{Vec3::Zero(), geometry::Mat3::Identity(), Vec3::Constant(0.1)};
  for (const bool wanted : {false, true})
    for (const bool moves : {false, true})
      for (const double longer : {1.0, 1.3}) {
        CAPTURE(wanted);
        CAPTURE(moves);
        CAPTURE(longer);
        TriMesh mesh;
        cloth::State state = pinned_sheet(mesh);
        state.options.doubled_when_stretched = wanted;
        collision::Collider body = ellipsoid_body(ball.center, ball.radii);
        std::vector<Vec3> at = mesh.positions;
        for (Vec3& p : at) p.x() *= longer;
        REQUIRE(cloth::set_pin_targets(at, state.pins) == (longer > 1.0));
        for (int frame = 0; frame < 3; ++frame) {
          ball.center.x() = moves ? 0.01 * frame : 0.0;
          body.move_to(std::span(&ball, 1), kFrame_s);
          const cloth::FrameReport report = cloth::advance({}, &body, kFrame_s, state);
          const bool doubled = wanted && moves && longer > 1.0 && frame > 0;
          CHECK(report.substeps == (doubled ? 2 : 1) * vacuum().substeps);
          CHECK(((report.limits & cloth::kMoreSubsteps) != 0) == doubled);
        }
      }
}

TEST_CASE("grip: a few particles that are flung are slowed, and take no more substeps") {
  const TriMesh mesh = sheet(24, 24, 0.6, 0.6, Vec3::Zero());
  auto state = cloth::make_state(mesh, {}, cotton(), vacuum());
  REQUIRE(state.ok());
  const auto fling = [&](std::size_t particles) {
    for (std::size_t i = 0; i < particles; ++i) state->particles.vx[i] = 200.0f;
    return cloth::advance({}, nullptr, kFrame_s, *state);
  };
  const cloth::FrameReport few = fling(2);
  CHECK(few.substeps == vacuum().substeps);
  CHECK((few.limits & cloth::kSpeedClamped) != 0);
  CHECK(fling(20).substeps > vacuum().substeps);
}

TEST_CASE("grip: friction acts by its share where the body moves, and wholly where it does not") {
  const double held = slip_left(true, 1.0f);
  CHECK(held < 1e-6);
  CHECK(slip_left(true, 0.0f) == doctest::Approx(1e-4).epsilon(0.05));
  CHECK(slip_left(true, 0.1f) > held + 3e-5);
  CHECK(slip_left(false, 0.0f) == doctest::Approx(held).epsilon(0.05));
}
