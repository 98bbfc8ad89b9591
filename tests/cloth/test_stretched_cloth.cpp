// Bounds on the time of a frame of crushed cloth. Stretched cloth loses friction on a moving body, and a few
// fast particles do not raise the number of substeps.
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

/// Displaces a particle that is 1 mm inside a ball by 0.1 mm along its surface, and resolves its contact.
/// Returns the displacement that friction has left, meters.
double displacement_left_m(bool moving, float share) {
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
  contacts.friction_share.assign(quad.positions.size(), share);
  cloth::Particles& p = state->particles;
  const Index at = state->particle_of_vertex[0];
  p.old_x = p.x, p.old_y = p.y, p.old_z = p.z;
  p.point[at].x += 1e-4f, p.point[at].y -= 1e-3f;
  cloth::resolve_body_contacts({}, &ball, options, {1e-3f, {}}, contacts, p);
  REQUIRE(contacts.touching[at]);
  return p.world(at).x();
}

}  // namespace

TEST_CASE("stretched cloth: on a moving body it has no friction while it is far beyond its strain limit") {
  TriMesh mesh;
  cloth::State state = pinned_sheet(mesh);
  std::vector<Vec3> at = mesh.positions;
  for (Vec3& p : at) p.x() *= p.x() > 0.26 ? 1.3 : 1.0;  // edges beyond the sixth column are 30 % longer
  REQUIRE(cloth::set_pin_targets(at, state.pins));
  const auto share_of = [&](std::size_t vertex) {
    return state.contacts.friction_share[state.particle_of_vertex[vertex]];
  };
  geometry::Ellipsoid ball{Vec3::Zero(), geometry::Mat3::Identity(), Vec3::Constant(0.1)};
  collision::Collider body = ellipsoid_body(ball.center, ball.radii);
  const auto advance = [&] {
    ball.center.x() += 0.001;
    body.move_to(std::span(&ball, 1), kFrame_s);
    cloth::advance({}, &body, kFrame_s, state);
  };
  for (int frame = 0; frame < 2; ++frame) {  // friction follows the strain when the last frame ended
    CHECK(share_of(10) == 1.0f);
    advance();
  }
  CHECK(share_of(0) == 1.0f);
  CHECK(share_of(10) == 0.0f);
  REQUIRE(cloth::set_pin_targets(mesh.positions, state.pins));
  for (int frame = 0; frame < 2; ++frame) advance();
  for (std::size_t v = 0; v < at.size(); ++v) CHECK(share_of(v) == 1.0f);
}

TEST_CASE("stretched cloth: with doubled_when_stretched, frames take twice the substeps on a moving body") {
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

TEST_CASE("fast particles: a few are slowed without more substeps, many get more substeps") {
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

TEST_CASE(
    "stretched cloth: a reduced share of friction acts on a moving body, full friction on a still one") {
  const double held = displacement_left_m(true, 1.0f);
  CHECK(held < 1e-6);
  CHECK(displacement_left_m(true, 0.0f) == doctest::Approx(1e-4).epsilon(0.05));
  CHECK(displacement_left_m(true, 0.1f) > held + 3e-5);
  CHECK(displacement_left_m(false, 0.0f) == doctest::Approx(held).epsilon(0.05));
}
