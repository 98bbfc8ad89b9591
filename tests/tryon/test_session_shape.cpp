// A slider gives the body of a session another shape. Surface, skin and held vertices change to it without a
// jump.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include <bodice/tryon/session.hpp>
#include <bodice_test/allocations.hpp>

#include "sheet.hpp"

using namespace bodice;
using geometry::Vec3;

namespace {

constexpr double kStep_s = 1.0 / 60.0;

tryon::SessionOptions options_of(bool moves) {
  tryon::SessionOptions options;
  options.fit.max_ellipsoids = 24;
  options.fit.measure_accuracy = false;
  options.moves = moves;
  options.refits = false;
  return options;
}

/// A session without workers: each frame does what is pending first.
std::unique_ptr<tryon::Session> begun(bool moves) {
  auto session = std::make_unique<tryon::Session>(engine::Context{}, options_of(moves));
  REQUIRE(session->dress({sheet(10)}).ok());
  auto body = session->submit(synth::BodyOptions{.vertices = 1500});
  if (moves) session->play({.motion = "walk"}, {.ramp_s = 0.1});
  REQUIRE(body.wait().ok());
  for (int frame = 0; frame < 20; ++frame) session->frame(kStep_s);
  REQUIRE(session->body() != nullptr);
  return session;
}

std::vector<Vec3> wider(const tryon::SegmentedSkin& skin) {
  std::vector<Vec3> positions = skin.input.skin.positions;
  for (Vec3& p : positions) p.x() *= 1.04, p.z() *= 1.08;
  return positions;
}

std::vector<Vec3> skin_of(const tryon::Session& session) {
  std::vector<Vec3> skin(session.body()->skin->input.skin.positions.size());
  session.skin_positions(skin);
  return skin;
}

double farthest_m(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double most = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, (a[i] - b[i]).norm());
  return most;
}

/// Distances from the session's collider at some points of the world.
std::vector<double> distances(const collision::Collider& collider, const std::vector<Vec3>& points) {
  std::vector<double> found;
  for (std::size_t i = 0; i < points.size(); i += 7) {
    const Eigen::Vector3f p = (points[i] - collider.origin()).cast<float>();
    found.push_back(double{collider.query({p.x(), p.y(), p.z()}).signed_distance});
  }
  return found;
}

double mean_m(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(a[i] - b[i]);
  return sum / static_cast<double>(a.size());
}

/// Runs five frames of a change of shape, which takes at least ten.
void check_that_frames_allocate_nothing(tryon::Session& session) {
  const std::size_t before = bodice_test::allocations();
  for (int frame = 0; frame < 5; ++frame) session.frame(kStep_s);
  if (bodice_test::counts_allocations()) CHECK(bodice_test::allocations() == before);
}

}  // namespace

TEST_CASE("a standing body changes its shape by at most 3 mm a frame, and its surface by 2 mm on average") {
  const auto session = begun(false);
  const std::vector<Vec3> points = session->body()->skin->input.skin.positions;
  const std::vector<Vec3> wanted = wider(*session->body()->skin);
  REQUIRE(farthest_m(points, wanted) > 0.01);
  REQUIRE(session->reshape(wanted).ok());
  std::vector<Vec3> skin = skin_of(*session);
  std::vector<double> distance = distances(*session->collider(), points);
  const std::vector<double> distance_before = distance;
  double skin_step_m = 0.0, surface_step_m = 0.0;
  int frames = 0;
  for (; frames < 60; ++frames) {
    session->frame(kStep_s);
    const std::vector<Vec3> now = skin_of(*session);
    const std::vector<double> distance_now = distances(*session->collider(), points);
    skin_step_m = std::max(skin_step_m, farthest_m(skin, now));
    surface_step_m = std::max(surface_step_m, mean_m(distance, distance_now));
    skin = now, distance = distance_now;
    if (now == wanted) break;
  }
  CHECK(frames > 5);
  CHECK(skin == wanted);
  CHECK(skin_step_m < 0.003);
  CHECK(surface_step_m < 0.002);
  CHECK(mean_m(distance, distance_before) > 0.004);  // the distance of a jump
  collision::Collider own(session->body()->proxy);
  own.cover({}, wanted);
  CHECK(mean_m(distance, distances(own, points)) < 1e-6);
}

TEST_CASE(
    "a second shape starts from the present surface, not from the earlier shape, and allocates nothing") {
  const auto session = begun(false);
  const std::vector<Vec3> first = session->body()->skin->input.skin.positions;
  REQUIRE(session->reshape(wider(*session->body()->skin)).ok());
  session->frame(kStep_s);
  check_that_frames_allocate_nothing(*session);
  const std::vector<Vec3> between = skin_of(*session);
  REQUIRE(session->reshape(first).ok());
  session->frame(kStep_s);
  CHECK(farthest_m(between, skin_of(*session)) < 0.003);
  for (int frame = 0; frame < 60; ++frame) session->frame(kStep_s);
  CHECK(skin_of(*session) == first);
}

TEST_CASE("a walking body keeps its velocity while its shape changes, and its surface follows") {
  const auto session = begun(true);
  const std::vector<Vec3> wanted = wider(*session->body()->skin);
  REQUIRE(farthest_m(wanted, session->body()->skin->input.skin.positions) > 0.02);
  const std::vector<Vec3> before = skin_of(*session);
  session->frame(kStep_s);
  std::vector<Vec3> now = skin_of(*session);
  for (std::size_t v = 0; v < now.size(); ++v) now[v] += now[v] - before[v];  // where it is a frame later
  REQUIRE(session->reshape(wanted).ok());
  session->frame(kStep_s);
  REQUIRE(session->body()->skin->input.skin.positions == wanted);
  // Arms and soles are where a wider body has them, and limbs gain speed.
  CHECK(farthest_m(now, skin_of(*session)) < 0.012);
  double off_m_s = 0.0, speed_m_s = 0.0;
  for (std::size_t v = 0; v < now.size(); v += 7) {
    const Vec3 local = now[v] - session->collider()->origin();
    const Eigen::Vector3f p = local.cast<float>();
    const auto contact = session->collider()->query({p.x(), p.y(), p.z()});
    const Vec3 velocity = session->collider()->surface_velocity(contact.ellipsoid, local);
    off_m_s += (velocity - (now[v] - before[v]) / (2.0 * kStep_s)).norm();
    speed_m_s += (now[v] - before[v]).norm() / (2.0 * kStep_s);
  }
  CHECK(off_m_s < 0.3 * speed_m_s);  // zero velocities would be off by all of it
  check_that_frames_allocate_nothing(*session);
  for (int frame = 0; frame < 40; ++frame) session->frame(kStep_s);
  const std::vector<Vec3> skin = skin_of(*session);
  const std::vector<double> distance = distances(*session->collider(), skin);
  CHECK(mean_m(distance, std::vector<double>(distance.size(), 0.0)) < 0.002);
}
