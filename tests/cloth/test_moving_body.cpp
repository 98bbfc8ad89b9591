// A moving body moves the cloth on it as fast as friction allows, and pushes the cloth in its path.
#include <doctest/doctest.h>
#include <bodice_test/allocations.hpp>
#include <bodice_test/executors.hpp>
#include <bodice_test/shapes.hpp>

#include <numbers>

#include "contact/continuous_contact.hpp"
#include "fixtures.hpp"

using namespace bodice;
using namespace bodice_test;

namespace {

cloth::Fabric undamped(double friction) {
  cloth::Fabric fabric = cotton();
  fabric.damping_per_s = 0.0;
  fabric.friction = friction;
  return fabric;
}

/// Options without gravity, in which the band would slip off: see the limits of friction in
/// modules/cloth/CONTACT.md.
cloth::SolverOptions weightless() {
  cloth::SolverOptions options = vacuum();
  options.environment.gravity_m_s2 = Vec3::Zero();
  return options;
}

/// So many particles at the origin, without a mass.
cloth::Particles particles_at_rest(std::size_t count) {
  cloth::Particles p;
  for (auto* values : {&p.x, &p.y, &p.z, &p.vx, &p.vy, &p.vz, &p.old_x, &p.old_y, &p.old_z})
    values->assign(count, 0.0f);
  p.size = count;
  return p;
}

void move(collision::Collider& body, const geometry::Ellipsoid& shape) {
  body.move_to({&shape, 1}, kFrame_s);
}

/// A spheroid about y that turns.
struct Turntable {
  geometry::Ellipsoid shape{Vec3(0, 1, 0), geometry::Mat3::Identity(), Vec3(0.15, 0.3, 0.15)};
  collision::Collider body = ellipsoid_body(shape.center, shape.radii);
  double angle_rad = 0.0;

  void turn(double by_rad) {
    angle_rad += by_rad;
    shape.axes = Eigen::AngleAxisd(angle_rad, Vec3::UnitY()).toRotationMatrix();
    move(body, shape);
  }
};

constexpr int kAround = 48, kRows = 4;

TriMesh band(double radius) {
  TriMesh mesh;
  for (int j = 0; j <= kRows; ++j)
    for (int i = 0; i < kAround; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / kAround;
      mesh.positions.emplace_back(radius * std::cos(angle), 0.96 + 0.02 * j, -radius * std::sin(angle));
    }
  for (Index j = 0; j < kRows; ++j)
    for (Index i = 0; i < kAround; ++i) {
      const Index a = j * kAround + i, b = j * kAround + (i + 1) % kAround;
      mesh.triangles.insert(mesh.triangles.end(), {{a, b, a + kAround}, {b, b + kAround, a + kAround}});
    }
  return mesh;
}

/// The mean rotation about y from one state to another, less than half a turn.
double turned_rad(const std::vector<Vec3>& from, const std::vector<Vec3>& to) {
  double sine = 0.0, cosine = 0.0;
  for (std::size_t v = 0; v < from.size(); ++v) {
    sine += from[v].z() * to[v].x() - from[v].x() * to[v].z();
    cosine += from[v].x() * to[v].x() + from[v].z() * to[v].z();
  }
  return std::atan2(sine, cosine);
}

/// A band on a turning body: it turns for a second and a half, and is measured over the last second.
struct Ride {
  double turned = 0.0;  ///< radians
  std::uint64_t hash = 0;
};

Ride ride(double friction, engine::Executor& executor) {
  Turntable table;
  const TriMesh mesh = band(0.149);
  cloth::Solver solver = make_solver(mesh, {}, undamped(friction), weightless());
  const engine::Context context{.executor = &executor};
  std::vector<Vec3> before;
  for (int frame = 0; frame < 90; ++frame) {
    if (frame == 30) before = positions(solver, mesh.positions.size());  // the band has its speed by now
    table.turn(1.5 * kFrame_s);
    solver.step(context, table.body, kFrame_s);
  }
  return {turned_rad(before, positions(solver, mesh.positions.size())), solver.hash()};
}

}  // namespace

TEST_CASE("moving body: a band turns with its body, and does not turn without friction") {
  CHECK(ride(0.45, engine::inline_executor()).turned == doctest::Approx(1.5).epsilon(0.005));
  CHECK(std::abs(ride(0.0, engine::inline_executor()).turned) < 0.02);
}

TEST_CASE("moving body: a band on it has the same bits for any number of workers") {
  const std::uint64_t serial = ride(0.45, engine::inline_executor()).hash;
  for (const int workers : {2, 3, 7}) CHECK(ride(0.45, *make_threads(workers)).hash == serial);
}

TEST_CASE("moving body: a band comes to rest when its body stops") {
  Turntable table;
  cloth::Solver solver = make_solver(band(0.149), {}, cotton(), weightless());
  for (int frame = 0; frame < 30; ++frame) {
    table.turn(1.5 * kFrame_s);
    solver.step({}, table.body, kFrame_s);
  }
  cloth::FrameReport report;
  for (int frame = 0; frame < 60; ++frame) {
    table.turn(0.0);
    report = solver.step({}, table.body, kFrame_s);
  }
  CHECK(report.median_speed_m_s < 1e-3);
  CHECK(report.asleep == solver.particles());
}

TEST_CASE("moving body: cloth on a sliding floor follows it while its acceleration is at most mu g") {
  constexpr double kMu = 0.4, kGravity = 9.81;
  for (const double acceleration : {0.5 * kMu * kGravity, 2.0 * kMu * kGravity}) {
    CAPTURE(acceleration);
    geometry::Ellipsoid floor{Vec3(0, 0, 0), geometry::Mat3::Identity(), Vec3(30, 5, 30)};
    collision::Collider body = ellipsoid_body(floor.center, floor.radii);
    const TriMesh mesh = sheet(10, 10, 0.3, 0.3, Vec3(-0.15, 5.001, -0.15));
    cloth::Solver solver = make_solver(mesh, {}, undamped(kMu), vacuum());
    for (int frame = 0; frame < 30; ++frame) solver.step({}, body, kFrame_s);
    const double start = positions(solver, mesh.positions.size())[60].x();
    for (int frame = 1; frame <= 30; ++frame) {
      floor.center.x() = 0.5 * acceleration * std::pow(frame * kFrame_s, 2);
      move(body, floor);
      solver.step({}, body, kFrame_s);
    }
    const double expected = 0.5 * std::min(acceleration, kMu * kGravity) * 0.25;
    CHECK(positions(solver, mesh.positions.size())[60].x() - start ==
          doctest::Approx(expected).epsilon(0.02));
  }
}

TEST_CASE("moving body: an arm that moves by its own width in a frame pushes a curtain without passing it") {
  geometry::Ellipsoid arm{Vec3(0, 0.7, -0.3), geometry::Mat3::Identity(), Vec3(0.5, 0.03, 0.03)};
  collision::Collider body = ellipsoid_body(arm.center, arm.radii);
  TriMesh mesh = sheet(30, 30, 0.6, 0.6, Vec3(-0.3, 0, 0));
  for (Vec3& p : mesh.positions) p = Vec3(p.x(), 1.0 - p.z(), 0.0);
  std::vector<Index> top;
  for (Index i = 0; i <= 30; ++i) top.push_back(i);
  cloth::Solver solver = make_solver(mesh, top, cotton(), {});
  for (int frame = 0; frame < 6; ++frame) {  // by 0.06 m a frame, to 0.06 m beyond the curtain
    arm.center.z() += 0.06;
    move(body, arm);
    CHECK(solver.step({}, body, kFrame_s).contacts.unresolved == 0);
    const std::vector<Vec3> now = positions(solver, mesh.positions.size());
    for (const Vec3& p : now) REQUIRE(geometry::closest_point(arm, p).signed_distance > -1e-5);
    for (Index i = 0; i <= 30; ++i) {  // each column still has particles in front of the arm
      double foremost = 0.0;
      for (Index j = 0; j <= 30; ++j) foremost = std::max(foremost, now[31 * j + i].z());
      CHECK(foremost > arm.center.z() + 0.01);
    }
  }
}

TEST_CASE("moving body: cloth stays on its limb when another limb moves to where the limb was") {
  constexpr double kRadius_m = 0.05, kAside_m = 0.13, kStart_m = 0.5, kFastest_m = 0.12, kFaster_m = 0.02;
  geometry::Ellipsoid limbs[2];
  proxy::BodyProxy::Data data;
  data.stature_m = 1.0;
  for (const int k : {0, 1}) {
    limbs[k].center = Vec3(k == 0 ? -kStart_m : kStart_m, 1.0, k == 0 ? 0.0 : kAside_m);
    limbs[k].radii = Vec3::Constant(kRadius_m);
    data.ellipsoids.push_back({});
    data.ellipsoids.back().shape = limbs[k];
  }
  collision::Collider body(*proxy::BodyProxy::make(std::move(data)));
  const TriMesh mesh = icosphere(kRadius_m + 0.003, 3, limbs[0].center);
  cloth::Solver solver = make_solver(mesh, {}, cotton(), weightless());
  solver.step({}, body, kFrame_s);
  double by_m = 0.0;
  for (int frame = 0; frame < 12; ++frame) {  // at 7.2 m/s where they pass
    by_m = std::min(kFastest_m, by_m + kFaster_m);
    limbs[0].center.x() += by_m, limbs[1].center.x() -= by_m;
    body.move_to(limbs, kFrame_s);
    solver.step({}, body, kFrame_s);
    CAPTURE(frame);
    double least_m = 1.0, most_m = -1.0;
    for (const Vec3& p : positions(solver, mesh.positions.size())) {
      const double distance_m = geometry::closest_point(limbs[0], p).signed_distance;
      least_m = std::min(least_m, distance_m), most_m = std::max(most_m, distance_m);
    }
    CHECK(least_m > -1e-4);
    CHECK(most_m < kRadius_m);
  }
}

TEST_CASE("moving body: continuous collision of one fast particle does not change its neighbors' pushes") {
  constexpr std::size_t kCount = 200, kLong = 70;
  geometry::Ellipsoid limb{Vec3::Zero(), geometry::Mat3::Identity(), Vec3(0.3, 0.05, 0.05)};
  collision::Collider body = ellipsoid_body(limb.center, limb.radii);
  limb.center.z() += 0.01;
  move(body, limb);
  // All press 0.5 mm into the limb from above. One was pulled through it, from 2 cm above it to 2 cm below.
  const auto resolve = [&](bool one_is_pulled) {
    cloth::Particles p = particles_at_rest(kCount);
    for (std::size_t i = 0; i < kCount; ++i) {
      p.x[i] = p.old_x[i] = 1e-3f * static_cast<float>(i) - 0.1f;
      p.y[i] = static_cast<float>(0.05 * std::sqrt(1.0 - std::pow(double{p.x[i]} / 0.3, 2)) - 5e-4);
      p.old_y[i] = p.y[i] + 1e-3f;
    }
    if (one_is_pulled) p.old_y[kLong] = 0.07f, p.y[kLong] = -0.07f;
    cloth::BodyMotion motion = cloth::make_motion(kCount, 0.5);
    motion.ccd_threshold_m = 0.01f;
    motion.ellipsoids.resize(body.size());
    cloth::begin_motion_frame({}, {.body = &body, .moving = true, .length_s = kFrame_s}, p, motion, {});
    const cloth::BodyContact contact = {
        .body = &body, .how = {.thickness_m = 0.002f}, .substep = {.share = {0.9f, 1.0f}}};
    const collision::ContactReport report = cloth::resolve_moving({}, contact, motion, 0, kCount, p);
    return std::pair(std::move(p), report);
  };
  const auto [with, of_all] = resolve(true);
  const auto [without, of_others] = resolve(false);
  CHECK(of_others.judged_exactly == 0);
  CHECK(of_all.judged_exactly == 1);
  CHECK(of_all.wrong_side == 1);
  CHECK(of_all.contacts == kCount);
  CHECK(with.y[kLong] > 0.04f);
  for (std::size_t i = 0; i < kCount; ++i)
    if (i != kLong) REQUIRE(with.y[i] == without.y[i]);
}

TEST_CASE("moving body: a push is along the body's normal at the end of the substep") {
  constexpr double kTurn_rad = 0.3;
  geometry::Ellipsoid limb{Vec3::Zero(), geometry::Mat3::Identity(), Vec3(0.3, 0.05, 0.05)};
  collision::Collider body = ellipsoid_body(limb.center, limb.radii);
  limb.axes = Eigen::AngleAxisd(kTurn_rad, Vec3::UnitZ()).toRotationMatrix();
  move(body, limb);
  cloth::Particles p = particles_at_rest(1);
  p.y[0] = static_cast<float>(0.052 - body.origin().y());
  cloth::BodyMotion motion = cloth::make_motion(1, 0.5);
  motion.ccd_threshold_m = 1.0f;
  motion.ellipsoids.resize(body.size());
  cloth::begin_motion_frame({}, {.body = &body, .moving = true, .length_s = kFrame_s}, p, motion, {});
  const Vec3 normal = Eigen::AngleAxisd(0.5 * kTurn_rad, Vec3::UnitZ()) * Vec3::UnitY();
  const Vec3 inside = 0.045 * normal - body.origin();
  p.x[0] = p.old_x[0] = static_cast<float>(inside.x()), p.y[0] = p.old_y[0] = static_cast<float>(inside.y());
  const cloth::BodyContact contact = {
      .body = &body, .how = {.thickness_m = 0.002f}, .substep = {.share = {0.4f, 0.5f}}};
  cloth::resolve_moving({}, contact, motion, 0, 1, p);
  const Vec3 push = Vec3(double{p.x[0]}, double{p.y[0]}, double{p.z[0]}) - inside;
  CHECK(push.norm() > 0.004);
  CHECK(push.normalized().dot(normal) > 0.999);
}

TEST_CASE("moving body: material of a limb that becomes flat in a frame moves with its surface") {
  for (const double flat : {0.6, 0.3, 0.1}) {
    geometry::Ellipsoid limb{Vec3::Zero(), geometry::Mat3::Identity(), Vec3(0.3, 0.05, 0.05)};
    collision::Collider body = ellipsoid_body(limb.center, limb.radii);
    limb.radii.y() *= flat;
    move(body, limb);
    cloth::Particles p = particles_at_rest(1);
    p.y[0] = static_cast<float>(0.05 - body.origin().y());
    cloth::BodyMotion motion = cloth::make_motion(1, 0.5);
    motion.ellipsoids.resize(body.size());
    cloth::begin_motion_frame({}, {.body = &body, .moving = true, .length_s = kFrame_s}, p, motion, {});
    CHECK(double{motion.displacement[0].y} == doctest::Approx(0.05 * (flat - 1.0)).epsilon(1e-3));
    CHECK(motion.displacement[0].x == doctest::Approx(0.0).epsilon(1e-6));
  }
}

TEST_CASE("moving body: a step allocates nothing once warm") {
  if (!bodice_test::counts_allocations()) return;
  Turntable table;
  cloth::Solver solver = make_solver(band(0.149), {}, cotton(), {});
  for (int frame = 0; frame < 3; ++frame) table.turn(0.02), solver.step({}, table.body, kFrame_s);
  const std::size_t before = bodice_test::allocations();
  for (int frame = 0; frame < 5; ++frame) table.turn(0.02), solver.step({}, table.body, kFrame_s);
  CHECK(bodice_test::allocations() == before);
}
