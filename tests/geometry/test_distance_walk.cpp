// Distances along a walk against those of single queries.
#include <doctest/doctest.h>

#include <cmath>

#include <bodice/engine/random.hpp>
#include <bodice/geometry/distance_walk.hpp>
#include <bodice_test/extremes.hpp>
#include <bodice_test/shapes.hpp>

using namespace bodice::geometry;
using namespace bodice_test;
using bodice::engine::Context;
using bodice::engine::Random;

namespace {

/// Walks near a mesh by random steps, most of them shorter than the distance and some across all of it.
void check_walk(const TriMesh& mesh) {
  const MeshDistance distance(Context{}, mesh);
  const Box box = bounding_box(mesh.positions);
  const double size = box.size().norm();
  DistanceWalk walk(distance);
  CHECK(walk.least_distance_m(box.center()) == -INFINITY);
  Random random(23);
  Vec3 at = box.center();
  for (int k = 0; k < 4000; ++k) {
    CAPTURE(k);
    const double step = size * std::pow(10.0, random.uniform(-4.0, -1.0));
    at += step * Vec3(random.normal(), random.normal(), random.normal());
    if (k % 50 == 0 || (at - box.center()).norm() > size)
      at = box.center() + 0.3 * size * Vec3(random.normal(), random.normal(), random.normal());
    const SurfacePoint alone = distance.closest_point(at);
    CHECK(walk.least_distance_m(at) <= alone.signed_distance + 1e-12 * size);
    const SurfacePoint walked = walk.closest_point(at);
    REQUIRE(walked.signed_distance == doctest::Approx(alone.signed_distance).epsilon(1e-13));
    CHECK(std::abs((walked.point - at).norm() - std::abs(alone.signed_distance)) <= 1e-12 * size);
  }
}

}  // namespace

TEST_CASE("a walk gives the distances of single queries on closed meshes") {
  check_walk(box({0.5, 1.0, 0.2}, 2));
  check_walk(torus(1.0, 0.3, 40, 20));
  check_walk(joined(icosphere(1.0, 3), icosphere(0.8, 3, {0.7, 0.2, 0.1})));
  check_walk(joined(icosphere(1.0, 2), icosphere(0.4, 2)));
}

TEST_CASE("a walk gives the distances of single queries on meshes with holes") {
  TriMesh leaky = torus(1.0, 0.4, 30, 16);
  std::erase_if(leaky.triangles, [n = 0](const Triangle&) mutable { return ++n % 11 == 0; });
  check_walk(leaky);
  check_walk(cylinder(0.3, 2.0, 24, 8, false));
  check_walk(sheet(1.0, 2.0, 5, 7));
}

TEST_CASE("a walk goes on after points that are absurd") {
  const MeshDistance distance(Context{}, icosphere(1.0, 3));
  DistanceWalk walk(distance);
  for (const double x : extreme_values()) {
    CAPTURE(x);
    CHECK_FALSE(std::isnan(walk.closest_point({x, 0.0, 0.0}).signed_distance));
    CHECK(walk.closest_point({0.1, 0.2, 0.3}).signed_distance == distance.signed_distance({0.1, 0.2, 0.3}));
  }
  const MeshDistance empty(Context{}, {});
  DistanceWalk nowhere(empty);
  CHECK(nowhere.closest_point(Vec3::Zero()).signed_distance == INFINITY);
  CHECK(nowhere.closest_point(Vec3::Ones()).signed_distance == INFINITY);
}
