// The tree against brute force over all triangles, and against closed forms.
#include <doctest/doctest.h>

#include <cmath>

#include <bodice/engine/parallel.hpp>
#include <bodice/engine/random.hpp>
#include <bodice/geometry/mesh_distance.hpp>
#include <bodice/geometry/mesh_repair.hpp>
#include <bodice_test/data.hpp>
#include <bodice_test/executors.hpp>
#include <bodice_test/extremes.hpp>
#include <bodice_test/read_mesh.hpp>
#include <bodice_test/shapes.hpp>

#include "brute_distance.hpp"

using namespace bodice::geometry;
using namespace bodice_test;
using bodice::engine::Context;
using bodice::engine::Random;

TEST_CASE("distance and sign agree with brute force on closed shapes") {
  check_against_brute_force(box({0.5, 1.0, 0.2}, 2), 300);
  check_against_brute_force(icosphere(1.0, 3), 150);
  check_against_brute_force(shuffled(torus(1.0, 0.3, 40, 20), 2), 100);
  check_against_brute_force(cylinder(0.3, 2.0, 24, 8), 150);
}

TEST_CASE("distance and sign agree with brute force where surfaces overlap, nest or have holes") {
  check_against_brute_force(joined(icosphere(1.0, 3), icosphere(0.8, 3, {0.7, 0.2, 0.1})), 150);
  check_against_brute_force(joined(icosphere(1.0, 2), icosphere(0.4, 2)), 150);
  TriMesh leaky = torus(1.0, 0.4, 30, 16);
  std::erase_if(leaky.triangles, [n = 0](const Triangle&) mutable { return ++n % 11 == 0; });
  check_against_brute_force(leaky, 150);
  check_against_brute_force(cylinder(0.3, 2.0, 24, 8, false), 150);
  check_against_brute_force(sheet(1.0, 2.0, 5, 7), 150);
}

TEST_CASE("the closest point among some triangles is that of a mesh of these alone") {
  const TriMesh mesh = torus(1.0, 0.3, 40, 20);
  const MeshDistance distance(Context{}, mesh);
  const auto counts = [](Index t) { return t % 7 == 3; };
  TriMesh some{.positions = mesh.positions, .triangles = {}};
  for (Index t = 0; t < mesh.triangles.size(); ++t)
    if (counts(t)) some.triangles.push_back(mesh.triangles[t]);
  for (const Vec3& query : queries_around(mesh, 100, 29)) {
    const double truth = brute_distance(some, query);
    const auto found = distance.closest_point_within(query, 1e3, counts);
    REQUIRE(found);
    CHECK(counts(found->triangle));
    CHECK(found->signed_distance == doctest::Approx(truth).epsilon(1e-12));
    CHECK_FALSE(distance.closest_point_within(query, truth * (1.0 - 1e-9) - 1e-12, counts));
  }
  CHECK_FALSE(distance.closest_point_within(Vec3::Zero(), 1e3, [](Index) { return false; }));
}

TEST_CASE("the extremes: every usable hostile mesh after repair, and no crash before") {
  for (const MeshCase& extreme : extreme_meshes()) {
    CAPTURE(extreme.name);
    const auto repaired = repair(Context{}, extreme.mesh);
    REQUIRE(repaired.ok() == extreme.usable);
    if (extreme.usable) check_against_brute_force(repaired->mesh, 30);
  }
}

TEST_CASE("a mesh is closed where its border is empty") {
  const auto is_closed = [](const TriMesh& mesh) { return MeshDistance(Context{}, mesh).is_closed(); };
  CHECK(is_closed({}));
  CHECK(is_closed(icosphere(1.0, 2)));
  CHECK(is_closed(joined(torus(1.0, 0.3, 40, 20), box({0.5, 1.0, 0.2}, 2))));
  CHECK_FALSE(is_closed(sheet(1.0, 2.0, 5, 7)));
  CHECK_FALSE(is_closed(cylinder(0.3, 2.0, 24, 8, false)));
  TriMesh mesh = icosphere(1.0, 2);
  std::swap(mesh.triangles[7][0], mesh.triangles[7][1]);
  CHECK_FALSE(is_closed(mesh));
  std::swap(mesh.triangles[7][0], mesh.triangles[7][1]);
  mesh.positions[3].x() = NAN;  // its triangles are left out
  CHECK_FALSE(is_closed(mesh));
}

TEST_CASE("an empty mesh is infinitely far") {
  const MeshDistance distance(Context{}, {});
  CHECK(distance.signed_distance(Vec3::Zero()) == INFINITY);
  CHECK(distance.closest_point(Vec3::Zero()).triangle == kNoIndex);
  CHECK_FALSE(distance.closest_point_within(Vec3::Zero(), 1e300));
  CHECK(distance.winding_number(Vec3::Zero()) == 0.0);
}

TEST_CASE("queries that are absurd get an answer, never NaN and never a crash") {
  const MeshDistance distance(Context{}, icosphere(1.0, 2));
  for (double x : extreme_values())
    for (double y : {0.0, x}) {
      CAPTURE(x);
      const SurfacePoint got = distance.closest_point({x, y, 0.0});
      CHECK_FALSE(std::isnan(got.signed_distance));
      CHECK_FALSE(std::isnan(distance.winding_number({x, y, 0.0})));
      if (std::isfinite(x) && std::abs(x) < 1e150) {
        CHECK(got.triangle != kNoIndex);
        CHECK(got.signed_distance <= std::hypot(x, y) * (1.0 + 1e-12) + 1.0);
      }
    }
}

TEST_CASE("a point on the surface is at distance zero") {
  const TriMesh mesh = icosphere(1.0, 3);
  const MeshDistance distance(Context{}, mesh);
  for (const Vec3& vertex : mesh.positions) CHECK(std::abs(distance.signed_distance(vertex)) < 1e-15);
}

TEST_CASE("real bodies: distance by brute force, sign by brute-force winding") {
  for (const char* name : {"bodies/f_avg_rest.obj", "bodies/f_avg_sit01.obj", "awkward/f_avg_holes.obj"}) {
    const auto file = data_file(name);
    if (!file) continue;
    CAPTURE(name);
    const auto repaired = repair(Context{}, read_mesh(*file));
    REQUIRE(repaired.ok());
    const MeshDistance distance(Context{}, repaired->mesh);
    int compared = 0;
    for (const Vec3& query : queries_around(repaired->mesh, 60, 23)) {
      const double got = distance.signed_distance(query);
      CHECK(std::abs(std::abs(got) - brute_distance(repaired->mesh, query)) < 1e-12);
      const double winding = brute_winding(repaired->mesh, query);
      if (std::abs(winding - 0.5) < 0.02) continue;
      ++compared;
      CHECK((got < 0.0) == (winding > 0.5));
    }
    CHECK(compared > 100);
  }
}

TEST_CASE("the tree has the same bits however many workers build it") {
  const TriMesh mesh = icosphere(1.0, 5);  // its upper nodes are built in tasks of their own
  REQUIRE(mesh.triangles.size() > 4096);
  const MeshDistance serial({}, mesh);
  for (const auto& [name, executor] : bodice_test::all_executors()) {
    CAPTURE(name);
    const MeshDistance built({.executor = executor.get()}, mesh);
    Random random(23);
    for (int i = 0; i < 500; ++i) {
      const Vec3 q(random.normal(), random.normal(), random.normal());
      const SurfacePoint a = serial.closest_point(q), b = built.closest_point(q);
      CHECK(a.triangle == b.triangle);
      CHECK(a.signed_distance == b.signed_distance);
      CHECK(serial.winding_number(q) == built.winding_number(q));
    }
  }
}

TEST_CASE("points a nanometer off the skin lie on its right side, which floats cannot show") {
  const TriMesh ball = bodice_test::icosphere(0.3137, 3);
  const MeshDistance distance({}, ball);
  for (std::size_t t = 0; t < ball.triangles.size(); ++t) {
    const Vec3 on = 0.2 * ball.corner(t, 0) + 0.5 * ball.corner(t, 1) + 0.3 * ball.corner(t, 2);
    const Vec3 out = area_vector(ball, t).normalized();
    for (const double height_m : {1e-7, 1e-8, 1e-9}) {
      CHECK(distance.inside(on - height_m * out));
      CHECK_FALSE(distance.inside(on + height_m * out));
    }
  }
}
