// Zones: particles that move together so that their pairs keep their distances.
#include <doctest/doctest.h>

#include "layer_fixtures.hpp"
#include "selfcontact/zones.hpp"

using namespace bodice;
using namespace bodice_test;

namespace {

/// Two edges at a right angle, one 1 mm above the other, as one pair that would cross.
struct CrossingEdges {
  std::vector<cloth::Point> before, now;
  cloth::Particles particles;
  cloth::Zones zones = cloth::make_zones(4);
  std::vector<cloth::PairTask> tasks = std::vector<cloth::PairTask>(1);

  CrossingEdges() {
    before = points_of({Vec3(-1, 0, 0), Vec3(1, 0, 0), Vec3(0, 1e-3, -1), Vec3(0, 1e-3, 1)});
    for (cloth::Point& p : before) p.weight = 1.0f;
    now = before;
    particles.size = 4;
    particles.mass.assign(4, 1.0f);
    tasks[0].pairs = {{.particle = {0, 1, 2, 3}, .edges = true}};
    tasks[0].crossing = {0};
  }

  /// Keeps a particle in front of a plane through where it is now.
  void guard(Index i, const Vec3& normal) {
    const Vec3 n = normal.normalized();
    zones.guard[i] = points_of({n})[0];
    zones.resolved[i] = now[i];
  }

  Vec3 moved(Index i) const {
    return {static_cast<double>(now[i].x - before[i].x), static_cast<double>(now[i].y - before[i].y),
            static_cast<double>(now[i].z - before[i].z)};
  }
};

}  // namespace

TEST_CASE("zones: a zone between slopes that face each other is lifted as a whole") {
  CrossingEdges edges;
  for (const Index i : {0u, 1u}) edges.now[i].y += 2e-3f;
  for (const Index i : {2u, 3u}) edges.now[i].y -= 4e-3f;
  edges.guard(0, Vec3(2, 1, 0));  // slopes of 63 degrees
  edges.guard(1, Vec3(-2, 1, 0));
  cloth::join_zones(edges.tasks, edges.particles, edges.before, edges.now, edges.zones);
  for (const Index i : {1u, 2u, 3u}) CHECK((edges.moved(i) - edges.moved(0)).norm() < 1e-6);
  // The mean is 1 mm down, and the guards begin 2 mm up, where both slopes meet.
  CHECK(edges.moved(0).y() == doctest::Approx(2e-3).epsilon(1e-3));
  CHECK(std::abs(edges.moved(0).x()) < 1e-6);
}

TEST_CASE("zones: pairs that were moved apart since they were found no longer count as pressed") {
  CrossingEdges edges;
  edges.tasks[0].pressed = edges.tasks[0].pairs;
  const cloth::Loose loose = cloth::make_loose(4);
  const cloth::ContactMesh mesh;
  const cloth::ContactSource source{mesh, {.gap_m = 2e-3f, .at = edges.before}, edges.before, {}, {}, loose};
  for (const Index i : {2u, 3u}) edges.now[i].y -= 2e-3f;
  cloth::drop_separated({}, source, edges.now, edges.tasks);
  CHECK(edges.tasks[0].pressed.size() == 1);
  for (const Index i : {2u, 3u}) edges.now[i].y += 2e-3f;
  cloth::drop_separated({}, source, edges.now, edges.tasks);
  CHECK(edges.tasks[0].pressed.empty());
}
