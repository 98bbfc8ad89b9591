// The solver: determinism, memory, rest, sleep, pins, layers and budget.
#include <doctest/doctest.h>
#include <bodice_test/allocations.hpp>
#include <bodice_test/executors.hpp>
#include <bodice_test/responses.hpp>

#include <algorithm>
#include <functional>
#include <set>

#include "fixtures.hpp"

using namespace bodice;
using namespace bodice_test;

namespace {

cloth::SolverOptions windy() {
  cloth::SolverOptions options;
  options.environment.wind_m_s = Vec3(3, 0, 1);
  options.environment.gust = 0.5;
  options.seed = 11;
  return options;
}

std::uint64_t hash_after(engine::Executor& executor, int frames) {
  const collision::Collider body = ellipsoid_body(Vec3(0, 1, 0), Vec3(0.2, 0.15, 0.2));
  // There are more particles than a task of any loop takes, so that workers share every loop.
  cloth::Solver solver = make_solver(sheet(80, 80, 0.8, 0.8, Vec3(-0.4, 1.16, -0.4)), {}, cotton(), windy());
  const engine::Context context{.executor = &executor};
  for (int frame = 0; frame < frames; ++frame) solver.step(context, body, kFrame_s);
  return solver.hash();
}

}  // namespace

TEST_CASE("solver: a garment in gusts has the same bits for any number of workers") {
  const std::uint64_t serial = hash_after(engine::inline_executor(), 12);
  for (const int workers : {1, 2, 3, 7}) {
    CHECK(hash_after(*bodice_test::make_threads(workers), 12) == serial);
  }
}

TEST_CASE("solver: a step allocates nothing once warm") {
  if (!bodice_test::counts_allocations()) return;
  const collision::Collider body = ellipsoid_body(Vec3(0, 1, 0), Vec3::Constant(0.2));
  cloth::Solver solver = make_solver(sheet(30, 30, 0.8, 0.8, Vec3(-0.4, 1.21, -0.4)), {}, cotton(), windy());
  const engine::Context context;
  for (int frame = 0; frame < 3; ++frame) solver.step(context, body, kFrame_s);
  const std::size_t before = bodice_test::allocations();
  for (int frame = 0; frame < 5; ++frame) solver.step(context, body, kFrame_s);
  CHECK(bodice_test::allocations() == before);
}

TEST_CASE("solver: the report's quantiles equal those of the sorted values") {
  const collision::Collider body = ellipsoid_body(Vec3(0, 1, 0), Vec3::Constant(0.2));
  const TriMesh mesh = sheet(70, 50, 0.8, 0.8, Vec3(-0.4, 1.21, -0.4));  // several tasks of every loop
  cloth::Solver solver = make_solver(mesh, {}, cotton(), windy());
  const engine::Context context;
  for (int frame = 0; frame < 20; ++frame) solver.step(context, body, kFrame_s);
  const auto before = positions(solver, mesh.positions.size());
  const cloth::FrameReport report = solver.step(context, body, kFrame_s);
  const auto after = positions(solver, mesh.positions.size());

  std::set<std::pair<Index, Index>> edges;
  for (const auto& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) edges.insert(std::minmax(t[k], t[(k + 1) % 3]));
  std::vector<double> strains, speeds;
  for (const auto& [a, b] : edges)
    strains.push_back((after[a] - after[b]).norm() / (mesh.positions[a] - mesh.positions[b]).norm() - 1.0);
  for (std::size_t v = 0; v < after.size(); ++v) speeds.push_back((after[v] - before[v]).norm() / kFrame_s);
  std::ranges::sort(strains, std::greater<>());
  std::ranges::sort(speeds);
  CHECK(report.stretch_max == doctest::Approx(strains.front()).epsilon(1e-3));
  CHECK(report.stretch_p95 == doctest::Approx(strains[strains.size() / 20]).epsilon(1e-3));
  CHECK(report.median_speed_m_s == doctest::Approx(speeds[(speeds.size() - 1) / 2]).epsilon(1e-3));
}

TEST_CASE("solver: a sheet on a body comes to rest and never gains energy meanwhile") {
  const collision::Collider body = ellipsoid_body(Vec3(0, 1, 0), Vec3(0.25, 0.2, 0.25));
  cloth::Solver solver = make_solver(sheet(24, 24, 0.7, 0.7, Vec3(-0.35, 1.21, -0.35)), {}, cotton(), {});
  const engine::Context context;
  cloth::FrameReport report = solver.step(context, body, kFrame_s);
  double energy = report.kinetic_energy_j + report.gravity_energy_j;
  const double weight_energy = 0.14 * 0.7 * 0.7 * 9.81 * 0.35;  // of a fall by half of its width, joules
  for (int frame = 0; frame < 600; ++frame) {
    report = solver.step(context, body, kFrame_s);
    const double now = report.kinetic_energy_j + report.gravity_energy_j;
    CHECK(now < energy + 0.01 * weight_energy);
    energy = std::min(energy, now);
  }
  CHECK(report.median_speed_m_s < 1e-3);
}

TEST_CASE("solver: at rest the total energy does not rise, and half of the particles sleep") {
  struct Case {
    int substeps;
    bool self_collision;
  };
  // With few substeps a sweep leaves large errors and folds tremble, but they have to come to rest as well.
  for (const Case which : {Case{2, true}, Case{4, true}, Case{8, false}, Case{8, true}, Case{16, true}}) {
    CAPTURE(which.substeps);
    const collision::Collider body = ellipsoid_body(Vec3(0, 1, 0), Vec3(0.25, 0.2, 0.25));
    const TriMesh mesh = sheet(24, 24, 0.7, 0.7, Vec3(-0.35, 1.21, -0.35));
    cloth::SolverOptions options;
    options.substeps = which.substeps;
    options.self_collision = which.self_collision;
    cloth::Solver solver = make_solver(mesh, {}, cotton(), options);
    const engine::Context context;
    cloth::FrameReport report;
    for (int frame = 0; frame < 300; ++frame) report = solver.step(context, body, kFrame_s);
    // The energy of a fall of the sheet by a millimeter is a hundredth of what folds still lose.
    const double millimeter_j = 0.14 * 0.7 * 0.7 * 9.81 * 1e-3;
    auto energy = [](const cloth::FrameReport& r) {
      return r.kinetic_energy_j + r.gravity_energy_j + r.elastic_energy_j;
    };
    double least = energy(report);
    for (int frame = 0; frame < 600; ++frame) {
      report = solver.step(context, body, kFrame_s);
      CHECK(energy(report) < least + millimeter_j);
      least = std::min(least, energy(report));
    }
    CHECK(report.median_speed_m_s < 1e-3);
    CHECK(report.asleep > solver.particles() / 2);

    cloth::Environment windy;
    windy.wind_m_s = Vec3(8, 0, 0);
    REQUIRE(solver.set_environment(windy).ok());
    for (int frame = 0; frame < 10; ++frame) report = solver.step(context, body, kFrame_s);
    CHECK(report.median_speed_m_s > 1e-2);
  }
}

TEST_CASE("sleep: particles wake when another body replaces the one below") {
  collision::Collider body = ellipsoid_body(Vec3(0, 0, 0), Vec3(3, 0.5, 3));
  cloth::Solver solver = make_solver(sheet(8, 8, 0.2, 0.2, Vec3(-0.1, 0.502, -0.1)), {}, cotton(), {});
  const engine::Context context;
  cloth::FrameReport report;
  for (int frame = 0; frame < 300; ++frame) report = solver.step(context, body, kFrame_s);
  REQUIRE(report.asleep == solver.particles());
  body = ellipsoid_body(Vec3(0, 0, 0), Vec3(3, 0.3, 3));  // the object and the origin stay the same
  for (int frame = 0; frame < 60; ++frame) report = solver.step(context, body, kFrame_s);
  std::vector<Vec3> at(solver.particles());
  solver.positions(at);
  for (const Vec3& p : at) CHECK(p.y() < 0.32);
}

TEST_CASE("sleep: particles wake when the body below is moved within 0 s") {
  geometry::Ellipsoid floor{Vec3(0, 0, 0), geometry::Mat3::Identity(), Vec3(3, 0.5, 3)};
  collision::Collider body = ellipsoid_body(floor.center, floor.radii);
  cloth::Solver solver = make_solver(sheet(8, 8, 0.2, 0.2, Vec3(-0.1, 0.502, -0.1)), {}, cotton(), {});
  const engine::Context context;
  cloth::FrameReport report;
  for (int frame = 0; frame < 300; ++frame) report = solver.step(context, body, kFrame_s);
  REQUIRE(report.asleep == solver.particles());
  floor.center.y() = -0.2;
  REQUIRE(body.move_to({&floor, 1}, 0.0));
  for (int frame = 0; frame < 60; ++frame) report = solver.step(context, body, kFrame_s);
  std::vector<Vec3> at(solver.particles());
  solver.positions(at);
  for (const Vec3& p : at) CHECK(p.y() < 0.32);
}

TEST_CASE("sleep: particles follow pins that begin to move slowly, and a new velocity, without stretching") {
  cloth::SolverOptions options;
  options.substeps = 16;
  const TriMesh mesh = sheet(10, 10, 0.3, 0.3, Vec3(-0.15, 1.0, -0.15));
  const std::vector<Index> pins = {0, 10};
  cloth::Solver solver = make_solver(mesh, pins, cotton(), options);
  const engine::Context context;
  cloth::FrameReport report;
  for (int frame = 0; frame < 1200 && report.asleep < solver.particles() - 2; ++frame)
    report = solver.step(context, kFrame_s);
  REQUIRE(report.asleep >= solver.particles() - 2);
  const double stretch_asleep = report.stretch_max;
  for (int frame = 1; frame <= 120; ++frame) {
    const Vec3 by(0.03 * kFrame_s * frame, 0.0, 0.0);  // 3 cm/s, which wakes no neighbor
    const Vec3 targets[] = {mesh.positions[pins[0]] + by, mesh.positions[pins[1]] + by};
    solver.move_pins(targets);
    report = solver.step(context, kFrame_s);
    REQUIRE(report.stretch_max < stretch_asleep + 0.02);
  }
  for (int frame = 0; frame < 1200 && report.asleep < solver.particles() - 2; ++frame)
    report = solver.step(context, kFrame_s);
  REQUIRE(report.asleep >= solver.particles() - 2);
  solver.set_velocity({0.0, 0.0, 0.5});
  report = solver.step(context, kFrame_s);
  CHECK(report.asleep == 0);
  CHECK(report.stretch_max < stretch_asleep + 0.1);
}

// The body's push of a pin is undone; a remaining velocity would drag the cloth in all later substeps.
TEST_CASE("pins: cloth around a pin inside the body stays at rest, for any number of substeps") {
  const TriMesh mesh = sheet(4, 4, 0.4, 0.4, Vec3(-0.2, 0.098, -0.2));
  const std::vector<Index> middle = {12};  // 2 mm inside a ball that no other particle of the sheet touches
  for (const auto& [name, response] : bodice_test::kResponses) {
    CAPTURE(name);
    const collision::Collider body = ellipsoid_body(Vec3::Zero(), Vec3::Constant(0.1));
    for (const int substeps : {2, 8, 32, 128}) {
      cloth::SolverOptions options = vacuum();
      options.environment.gravity_m_s2 = Vec3::Zero();
      options.substeps = substeps, options.response = response;
      cloth::Solver solver = make_solver(mesh, middle, cotton(), options);
      const engine::Context context;
      for (int frame = 0; frame < 3; ++frame) {
        const cloth::FrameReport report = solver.step(context, body, kFrame_s);
        CHECK(report.contacts.contacts > 0);
        CHECK(report.median_speed_m_s < 1e-6);
      }
      const std::vector<Vec3> at = positions(solver, mesh.positions.size());
      for (std::size_t v = 0; v < at.size(); ++v) CHECK((at[v] - mesh.positions[v]).norm() < 1e-6);
    }
  }
}

TEST_CASE("solver: a first frame of 0 s reports a garment at rest") {
  cloth::Solver solver = make_solver(sheet(6, 6, 0.2, 0.2, Vec3(0, 1, 0)), {}, cotton(), {});
  const cloth::FrameReport report = solver.step({}, 0.0);
  CHECK(report.stretch_max < 1e-5);
  CHECK(report.elastic_energy_j < 1e-6);
}

TEST_CASE("gusts: the seed changes the result with gusts, and not without them") {
  auto drift = [](double gust, std::uint64_t seed) {
    cloth::SolverOptions options = windy();
    options.environment.gust = gust;
    options.seed = seed;
    cloth::Solver solver = make_solver(sheet(8, 8, 0.4, 0.4, Vec3::Zero()), {}, cotton(), options);
    const engine::Context context;
    for (int frame = 0; frame < 10; ++frame) solver.step(context, kFrame_s);
    return solver.hash();
  };
  CHECK(drift(0.0, 1) == drift(0.0, 2));
  CHECK(drift(0.5, 1) == drift(0.5, 1));
  CHECK(drift(0.5, 1) != drift(0.5, 2));
}

TEST_CASE("self-contact: a layer dropped on another one lies on it; without self-contact it sinks in") {
  const collision::Collider body = ellipsoid_body(Vec3(0, 0, 0), Vec3(3, 0.5, 3));
  TriMesh mesh = sheet(16, 16, 0.4, 0.4, Vec3(-0.2, 0.5, -0.2));
  const TriMesh top = sheet(16, 16, 0.4, 0.4, Vec3(-0.19, 0.53, -0.19));
  const auto first = static_cast<Index>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), top.positions.begin(), top.positions.end());
  for (const auto& t : top.triangles) mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  const engine::Context context;
  auto mean_gap = [&](bool self) {
    cloth::SolverOptions options;
    options.self_collision = self;
    cloth::Solver solver = make_solver(mesh, {}, cotton(), options);
    for (int frame = 0; frame < 90; ++frame) solver.step(context, body, kFrame_s);
    const auto now = positions(solver, mesh.positions.size());
    double gap = 0.0;
    for (Index v = 0; v < first; ++v) gap += (now[v + first][1] - now[v][1]) / first;
    return gap;
  };
  CHECK(mean_gap(true) == doctest::Approx(cloth::SolverOptions{}.layer_gap_m).epsilon(0.1));
  CHECK(std::abs(mean_gap(false)) < 0.002);
}

TEST_CASE("budget: frames over the budget drop work in the stated order, and report it") {
  cloth::SolverOptions options;
  options.budget_us = 1e-3;
  cloth::Solver solver = make_solver(sheet(8, 8, 0.4, 0.4, Vec3::Zero()), {}, cotton(), options);
  const engine::Context context;
  constexpr std::uint32_t kBits = cloth::kNoSelfContact | cloth::kBendingHalved | cloth::kSubstepsHalved;
  std::vector<std::uint32_t> dropped;
  for (int frame = 0; frame < 5; ++frame) dropped.push_back(solver.step(context, kFrame_s).limits & kBits);
  CHECK(dropped == std::vector<std::uint32_t>{0, cloth::kNoSelfContact,
                                              cloth::kNoSelfContact | cloth::kBendingHalved, kBits, kBits});
}

TEST_CASE("self-contact: layers that meet after the body below is removed keep their total momentum") {
  const collision::Collider body = ellipsoid_body(Vec3(0, 0, 0), Vec3(3, 0.5, 3));
  TriMesh mesh = sheet(8, 8, 0.2, 0.2, Vec3(-0.1, 0.502, -0.1));
  const TriMesh top = sheet(8, 8, 0.2, 0.2, Vec3(-0.09, 0.53, -0.09));
  const auto first = static_cast<Index>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), top.positions.begin(), top.positions.end());
  for (const auto& t : top.triangles) mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  cloth::SolverOptions options = vacuum();
  options.self_collision = true;
  cloth::Solver solver = make_solver(mesh, {}, cotton(), options);
  const engine::Context context;
  const auto mean_height = [&](Index begin, Index end) {
    double sum = 0.0;
    const auto now = positions(solver, mesh.positions.size());
    for (Index v = begin; v < end; ++v) sum += now[v][1];
    return sum / (end - begin);
  };
  const auto mean_speed = [&](Index begin, Index end) {
    const double before = mean_height(begin, end);
    solver.step(context, kFrame_s);
    return (mean_height(begin, end) - before) / kFrame_s;
  };
  const auto last = static_cast<Index>(mesh.positions.size());
  // The lower layer lies on the body when the upper one is about to reach it.
  while (mean_height(first, last) - mean_height(0, first) > 0.015) {
    const cloth::FrameReport report = solver.step(context, body, kFrame_s);
    REQUIRE(report.finite);
  }
  // They meet in the first of these frames. If the lower layer were still held, the upper one would bounce
  // off.
  double speed = mean_speed(0, last);
  for (int frame = 0; frame < 6; ++frame) {
    const double now = mean_speed(0, last);
    CHECK(now - speed == doctest::Approx(-9.81 * kFrame_s).epsilon(0.01));
    speed = now;
  }
}
