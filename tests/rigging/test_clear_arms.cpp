#include <bodice/rigging/clear_arms.hpp>

#include <algorithm>

#include <doctest/doctest.h>
#include <bodice/geometry/mesh_distance.hpp>

#include "posed.hpp"

namespace {

using namespace bodice;
using geometry::Vec3;
using rigging::Motion;

bool is_arm(body::Part part) {
  return part >= body::Part::kUpperArmL && part <= body::Part::kForearmR;
}

/// Deepest point of forearms and hands inside the rest of the posed skin, in eight moments of a motion,
/// meters; negative: how far the nearest one is off.
double deepest(const synth::Body& body, Motion motion, double arms_out_deg) {
  const rig::Clip clip = posed::made_clip(body.skeleton, motion, {.arms_out_deg = arms_out_deg});
  double depth = -1.0;
  for (int k = 0; k < 8; ++k) {
    geometry::TriMesh rest{posed::skin_at(body, clip, clip.duration_s * (k + 0.5) / 8.0), {}};
    for (const geometry::Triangle& t : body.mesh.triangles)
      if (std::none_of(t.begin(), t.end(), [&](geometry::Index v) { return is_arm(body.part[v]); }))
        rest.triangles.push_back(t);
    const geometry::MeshDistance distance({}, rest);
    for (std::size_t v = 0; v < body.part.size(); v += 3)
      if (body.part[v] == body::Part::kForearmL || body.part[v] == body::Part::kForearmR)
        depth = std::max(depth, -distance.signed_distance(rest.positions[v]));
  }
  return depth;
}

/// Area of the upper arms' skin that lies inside other skin, the most of eight moments of a walk, square
/// meters. It is decided by winding numbers, so that no distance of clear_arms_deg() is used.
double skin_in_skin(const synth::Body& body, double arms_out_deg) {
  const rig::Clip clip = posed::made_clip(body.skeleton, Motion::kWalk, {.arms_out_deg = arms_out_deg});
  double most = 0.0;
  for (int k = 0; k < 8; ++k) {
    const geometry::TriMesh skin{posed::skin_at(body, clip, clip.duration_s * (k + 0.5) / 8.0),
                                 body.mesh.triangles};
    const geometry::MeshDistance distance({}, skin);
    double area = 0.0;
    for (const geometry::Triangle& t : skin.triangles) {
      const body::Part part = body.part[t[0]];
      if (part != body::Part::kUpperArmL && part != body::Part::kUpperArmR) continue;
      const Vec3 &a = skin.positions[t[0]], &b = skin.positions[t[1]], &c = skin.positions[t[2]];
      const Vec3 across = (b - a).cross(c - a);
      if (distance.winding_number((a + b + c) / 3.0 + 1e-4 * across.normalized()) > 0.5)
        area += 0.5 * across.norm();
    }
    most = std::max(most, area);
  }
  return most;
}

TEST_CASE("with the angle that is found, upper arms do not walk inside the trunk") {
  for (const double mass_kg : {52.0, 62.0, 72.0}) {
    CAPTURE(mass_kg);
    const synth::Body body = posed::made_body({.mass_kg = mass_kg, .vertices = 3000});
    const double out = rigging::clear_arms_deg(body.mesh, body.part, {body.skeleton, body.weights, {}});
    const double hanging = skin_in_skin(body, 0.0), held_out = skin_in_skin(body, out);
    CAPTURE(out);
    CAPTURE(hanging);
    CHECK(held_out < 0.1 * hanging);
  }
}

TEST_CASE("arms of a body that changes its shape come to the angle that it needs in small steps") {
  const synth::Body body = posed::made_body({.mass_kg = 62.0, .vertices = 3000});
  const rig::Rig rig{body.skeleton, body.weights, {}};
  const double needed = rigging::clear_arms_deg(body.mesh, body.part, rig);
  REQUIRE(needed > 6.0);
  REQUIRE(needed < 14.0);
  for (const double from : {needed - 3.0, needed + 3.0}) {
    double now = from;
    for (int shape = 0; shape < 12; ++shape) {
      const double next = rigging::keep_arms_clear_deg(body.mesh, body.part, rig, now);
      CHECK(std::abs(next - now) < 0.34);
      now = next;
    }
    CHECK(std::abs(now - needed) < 2.0);  // the pressed area of a coarse skin changes by whole triangles
    CHECK(rigging::keep_arms_clear_deg(body.mesh, body.part, rig, now) == doctest::Approx(now).epsilon(0.05));
  }
}

TEST_CASE("with the angle that is found, the hands of slim and of heavy bodies clear trunk and thighs") {
  double heaviest = 0.0;
  for (const double mass_kg : {52.0, 62.0, 78.0, 95.0}) {
    CAPTURE(mass_kg);
    const synth::Body body = posed::made_body({.mass_kg = mass_kg, .vertices = 3000});
    const double out = rigging::clear_arms_deg(body.mesh, body.part, {body.skeleton, body.weights, {}});
    CAPTURE(out);
    CHECK(out >= heaviest);  // the wider the body, the more
    heaviest = out;
    for (const Motion motion : {Motion::kWalk, Motion::kTurn, Motion::kSit, Motion::kDance})
      CHECK(deepest(body, motion, out) < 0.008);
    CHECK(deepest(body, Motion::kRun, out) < -0.05);  // a skirt has room
  }
  CHECK(heaviest > 5.0);
  CHECK(heaviest < 17.0);
  const synth::Body heavy = posed::made_body({.mass_kg = 95.0, .vertices = 3000});
  CHECK(deepest(heavy, Motion::kWalk, 0.0) > 0.03);  // without it they do not
}

TEST_CASE("the angle that arms need does not depend on the pose or the heading of the bound skin") {
  const auto needed = [](synth::Pose pose) {
    const synth::Body body = posed::made_body({.mass_kg = 90.0, .pose = pose, .vertices = 3000, .seed = 5});
    return rigging::clear_arms_deg(body.mesh, body.part, {body.skeleton, body.weights, {}});
  };
  const double standing = needed(synth::Pose::kA);
  CHECK(standing > 3.0);
  for (const synth::Pose pose : {synth::Pose::kSit, synth::Pose::kLying, synth::Pose::kRandom})
    CHECK(std::abs(needed(pose) - standing) < 4.0);
}

TEST_CASE("a skeleton that is not the common one needs no angle") {
  synth::Body body = posed::made_body({.vertices = 2000});
  body.skeleton.joints[0].name = "hips";
  CHECK(rigging::clear_arms_deg(body.mesh, body.part, {body.skeleton, body.weights, {}}) == 0.0);
}

}  // namespace
