// Pins that yield to other layers of cloth, and pins that do not.
#include <doctest/doctest.h>

#include "layer_fixtures.hpp"

using namespace bodice;
using namespace bodice_test;

namespace {

constexpr double kSide_m = 0.3, kBelow_m = 0.015, kRise_m = 0.04;
constexpr int kRaised = 30, kFrames = 90;  // frames until the sheet is raised, and in all

/// Two sheets of which all vertices are pinned. The lower one is raised at one side, so that it would cross
/// the upper one as a slope, and goes back.
LayerScene pinned_sheets() {
  LayerScene scene;
  scene.mesh = sheet(6, 6, kSide_m, kSide_m, Vec3::Zero());
  append(sheet(6, 6, kSide_m, kSide_m, Vec3(0.013, -kBelow_m, 0.017)), scene.mesh);
  for (Index v = 0; v < scene.mesh.positions.size(); ++v) scene.pins.push_back(v);
  scene.body = {geometry::Ellipsoid{.center = Vec3(0, -10, 0)}};
  scene.pin_at = [](const Vec3& start, double time_s) {
    const double frame = time_s / kFrame_s,
                 risen = std::clamp(1.0 - std::abs(frame / kRaised - 1.0), 0.0, 1.0);
    return start.y() < -1e-6 ? Vec3(start + Vec3(0, risen * kRise_m * start.x() / kSide_m, 0)) : start;
  };
  scene.frames = kFrames;
  return scene;
}

/// The largest distance of a pin from its target, over all frames of a scene and at the end, meters.
struct PinsOff {
  double farthest_m = 0.0, at_end_m = 0.0;
};

PinsOff pins_off(const LayerScene& scene, const cloth::SolverOptions& how) {
  cloth::Solver solver = make_solver(scene.mesh, scene.pins, cotton(), how);
  PinsOff off;
  for (int frame = 1; frame <= scene.frames; ++frame) {
    std::vector<Vec3> targets;
    for (const Index v : scene.pins)
      targets.push_back(scene.pin_at(scene.mesh.positions[v], frame * kFrame_s));
    solver.move_pins(targets);
    solver.step({}, kFrame_s);
    const std::vector<Vec3> at = positions(solver, scene.mesh.positions.size());
    off.at_end_m = 0.0;
    for (std::size_t k = 0; k < targets.size(); ++k)
      off.at_end_m = std::max(off.at_end_m, (at[scene.pins[k]] - targets[k]).norm());
    off.farthest_m = std::max(off.farthest_m, off.at_end_m);
  }
  return off;
}

}  // namespace

TEST_CASE("pins: layers of pins that press through each other cross, unless the pins yield") {
  cloth::SolverOptions how = layered(true);
  const LayerOutcome rigid = play(pinned_sheets(), how);
  how.pins_yield = true;
  const LayerOutcome yielding = play(pinned_sheets(), how);
  CHECK(rigid.worst > 0);
  CHECK(yielding.worst == 0);
}

TEST_CASE("pins: pins that yielded are on their targets again once there is room") {
  cloth::SolverOptions how = layered(true);
  how.pins_yield = true;
  const PinsOff off = pins_off(pinned_sheets(), how);
  CHECK(off.farthest_m > 5e-3);
  CHECK(off.at_end_m < 1e-6);
}

TEST_CASE("pins: a pin that yields is pushed out of the body, and one that does not stays inside") {
  const TriMesh mesh = sheet(4, 4, 0.4, 0.4, Vec3(-0.2, 0.098, -0.2));
  const std::vector<Index> middle = {12};  // 2 mm inside the ball
  const collision::Collider body = ellipsoid_body(Vec3::Zero(), Vec3::Constant(0.1));
  for (const bool yields : {false, true}) {
    cloth::SolverOptions options = vacuum();
    options.environment.gravity_m_s2 = Vec3::Zero();
    options.pins_yield = yields;
    cloth::Solver solver = make_solver(mesh, middle, cotton(), options);
    for (int frame = 0; frame < 3; ++frame) solver.step({}, body, kFrame_s);
    const double height_m = positions(solver, mesh.positions.size())[middle.front()].y();
    CHECK(height_m == doctest::Approx(yields ? 0.1 + options.thickness_m : 0.098).epsilon(1e-5));
  }
}

TEST_CASE("pins: crossing layers that are drawn apart do not carry pins along") {
  LayerScene scene;
  scene.mesh = sheet(6, 6, kSide_m, kSide_m, Vec3::Zero());
  for (Index v = 0; v < scene.mesh.positions.size(); ++v) scene.pins.push_back(v);
  const auto upright = [](double u, double v) {
    return Vec3(0.13, (u - 0.47) * kSide_m, (v + 0.03) * kSide_m);
  };
  append(surface(6, 6, false, upright), scene.mesh);
  REQUIRE(crossings(scene.mesh, scene.mesh.positions) > 0);
  scene.pin_at = [](const Vec3& start, double) { return start; };
  cloth::SolverOptions how = layered(true);
  how.pins_yield = true;
  how.environment.gravity_m_s2 = Vec3::Zero();
  CHECK(pins_off(scene, how).farthest_m < 5e-3);
}

TEST_CASE("pins: a layer that slides over pins drags them by little more than a centimeter") {
  LayerScene scene;
  scene.mesh = sheet(6, 6, kSide_m, kSide_m, Vec3::Zero());
  append(sheet(6, 24, kSide_m, 4 * kSide_m, Vec3(0.013, 0.002, -3.5 * kSide_m)), scene.mesh);
  for (Index v = 0; v < scene.mesh.positions.size(); ++v) scene.pins.push_back(v);
  constexpr double kSpeed_m_s = 3.0;
  scene.pin_at = [](const Vec3& start, double time_s) {
    return start.y() > 1e-6 ? Vec3(start + Vec3(0, -0.004, kSpeed_m_s * time_s)) : start;
  };
  scene.frames = 28;
  cloth::SolverOptions how = layered(true);
  how.pins_yield = true;
  const double farthest_m = pins_off(scene, how).farthest_m;
  CHECK(farthest_m > 2e-3);
  CHECK(farthest_m < 0.0115);
}
