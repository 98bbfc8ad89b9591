#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include <bodice/proxy/proxy_distance.hpp>

#include <bodice_test/targets.hpp>
#include "scenes.hpp"

using namespace bodice;
using namespace bodice::collision;
using namespace bodice_test;

namespace {

/// Largest disagreement of a batch with the oracle, relative to `scale_m`.
struct Errors {
  double distance = 0.0, point = 0.0;
  int wrong_owner = 0;
};

Errors compare(const std::vector<Ellipsoid>& shapes, const std::vector<Vec3>& points, double scale_m) {
  const Collider collider(proxy_of(shapes));
  Cloud cloud;
  for (const Vec3& p : points) cloud.add(p - collider.origin());
  std::vector<Contact> contacts(cloud.size());
  collider.query({}, cloud.particles(), contacts);
  Errors errors;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Vec3 p = cloud.position(i) + collider.origin();
    const auto truth = brute_force(shapes, p);
    const Contact& c = contacts[i];
    errors.distance =
        std::max(errors.distance, std::abs(double{c.signed_distance} - truth.signed_distance) / scale_m);
    // The closest point may be ambiguous; it is only checked to lie on the owner's surface.
    const Vec3 point = Vec3(double{c.point[0]}, double{c.point[1]}, double{c.point[2]}) + collider.origin();
    if (c.ellipsoid >= shapes.size()) {
      ++errors.wrong_owner;
      continue;
    }
    const auto own = geometry::closest_point(shapes[c.ellipsoid], p);
    errors.point =
        std::max(errors.point,
                 std::abs(geometry::closest_point(shapes[c.ellipsoid], point).signed_distance) / scale_m);
    if (own.signed_distance > truth.signed_distance + 2e-6 * scale_m) ++errors.wrong_owner;
  }
  return errors;
}

/// A point on the union's surface where the owner changes, and a random direction.
struct Crease {
  Vec3 position, direction;
};

std::vector<Crease> find_creases(const std::vector<Ellipsoid>& shapes, std::uint64_t seed, std::size_t most) {
  engine::Random random(seed);
  const auto on_surface = [&](const Vec3& p, std::uint32_t& owner) {
    return brute_force(shapes, p, &owner).point;
  };
  std::vector<Crease> creases;
  for (std::size_t tried = 0; tried < 20 * most && creases.size() < most; ++tried) {
    const Ellipsoid& e = shapes[random.below(shapes.size())];
    std::uint32_t first = 0, second = 0, owner = 0;
    Vec3 a = on_surface(geometry::radial_projection(e, e.center + random_direction(random)), first);
    Vec3 b = on_surface(a + random_vector(random, 0.1), second);
    if (first == second) continue;
    for (int halving = 0; halving < 40; ++halving) {
      const Vec3 middle = on_surface(0.5 * (a + b), owner);
      (owner == first ? a : b) = middle;
    }
    if ((b - a).norm() < 1e-6) creases.push_back({a, random_direction(random)});
  }
  return creases;
}

}  // namespace

TEST_CASE("a batch query agrees with brute force in double precision over random unions") {
  for (const int count : {1, 2, 17, 89, 300}) {
    const auto shapes = random_ellipsoids(static_cast<std::uint64_t>(count), count, 0.8, 0.02, 0.2);
    const Errors errors = compare(shapes, points_around(5, 20000, 1.2), 1.0);
    CAPTURE(count);
    // The farthest points are 2 m away; relative to that the bar is a few roundings.
    CHECK(errors.distance < 2e-6);
    CHECK(errors.point < 2e-6);
    CHECK(errors.wrong_owner == 0);
  }
}

TEST_CASE("a query agrees with brute force for neighboring particles near the surface, as in cloth") {
  const auto shapes = random_ellipsoids(3, 89, 0.6, 0.03, 0.2);
  std::vector<Vec3> points;
  engine::Random random(9);
  for (int patch = 0; patch < 200; ++patch) {
    const Ellipsoid& e = shapes[random.below(shapes.size())];
    const Vec3 middle = geometry::radial_projection(e, e.center + random_direction(random));
    for (int i = 0; i < 64; ++i) points.push_back(middle + random_vector(random, 0.02));
  }
  const Errors errors = compare(shapes, points, 1.0);
  CHECK(errors.distance < 1e-6);
  CHECK(errors.point < 1e-6);
  CHECK(errors.wrong_owner == 0);
}

TEST_CASE("a query finds the nearer of two ellipsoids next to a crease, on every instruction set" *
          doctest::test_suite("long")) {
  const auto shapes = random_ellipsoids(21, 40, 0.4, 0.05, 0.4);
  const auto creases = find_creases(shapes, 4, 300);
  REQUIRE(creases.size() == 300);
  std::vector<Vec3> points;
  engine::Random random(5);
  for (const Crease& crease : creases)
    for (int i = 0; i < 16; ++i)
      points.push_back(crease.position + random.uniform(-2e-4, 2e-4) * crease.direction);
  on_every_target([&](const std::string& target) {
    const Errors errors = compare(shapes, points, 1.0);
    CAPTURE(target);
    CHECK(errors.distance < 1e-6);
    CHECK(errors.wrong_owner == 0);
  });
}

TEST_CASE("a query agrees with brute force for needles, discs and balls, at centers and on symmetry planes") {
  for (const double size_m : {1e-6, 1e-3, 1.0, 1e3, 1e6}) {
    for (const Vec3& aspect :
         {Vec3(1, 1, 1), Vec3(1, 1, 1e-3), Vec3(1, 1e-3, 1e-3), Vec3(1, 0.5, 1e-3), Vec3(1e-2, 1, 1)}) {
      Ellipsoid e;
      e.center = size_m * Vec3(0.3, -0.2, 0.1);
      e.axes = Mat3::Identity();
      e.radii = size_m * aspect;
      std::vector<Vec3> points;
      for (int mask = 0; mask < 8; ++mask)
        for (const Vec3& p : points_around(4, 300, 1.5))
          points.push_back(e.center + size_m * p.cwiseProduct(Vec3(mask & 1, mask >> 1 & 1, mask >> 2 & 1)));
      const Errors errors = compare({e}, points, size_m);
      CAPTURE(size_m);
      CAPTURE(aspect.transpose());
      CHECK(errors.distance < 2e-6);
      CHECK(errors.point < 2e-6);
      CHECK(errors.wrong_owner == 0);
    }
  }
}

TEST_CASE("a query agrees with brute force for identical, nested and tangent ellipsoids, also on overflow") {
  const auto one = random_ellipsoids(2, 1, 0.1, 0.1, 0.3);
  std::vector<Ellipsoid> crowd(4096, one[0]);
  CHECK(compare(crowd, points_around(1, 300, 0.6), 1.0).distance < 1e-6);
  std::vector<Ellipsoid> nested(5, one[0]);
  for (std::size_t k = 0; k < nested.size(); ++k) nested[k].radii *= 1.0 - 0.15 * static_cast<double>(k);
  CHECK(compare(nested, points_around(1, 5000, 0.6), 1.0).distance < 1e-6);
  std::vector<Ellipsoid> tangent(2);
  for (Ellipsoid& e : tangent) e.radii.setConstant(0.5);
  tangent[0].center.x() = -0.5;
  tangent[1].center.x() = 0.5;
  CHECK(compare(tangent, points_around(1, 5000, 1.0), 1.0).distance < 1e-6);
  CHECK(compare(tangent, std::vector<Vec3>(100, Vec3::Zero()), 1.0).distance < 1e-6);
}

TEST_CASE("a query agrees with brute force for 700 different ellipsoids around one point" *
          doctest::test_suite("long")) {
  const auto shapes = random_ellipsoids(5, 700, 0.05, 0.08, 0.1);
  const Errors errors = compare(shapes, points_around(3, 3000, 0.2), 0.2);
  CHECK(errors.distance < 2e-6);
  CHECK(errors.wrong_owner == 0);
}

TEST_CASE("a query agrees with brute force for blocks from a tenth of a millimeter to half a meter" *
          doctest::test_suite("long")) {
  // Blocks measure a tenth of a millimeter to half a meter. An ellipsoid that is dropped for a block must be
  // nearest to none of its points.
  const auto shapes = random_ellipsoids(13, 120, 0.6, 0.03, 0.2);
  engine::Random random(19);
  for (const double block_m : {1e-4, 1e-3, 1e-2, 0.1, 0.5}) {
    std::vector<Vec3> points;
    for (int block = 0; block < 60; ++block) {
      const Vec3 middle = random_vector(random, 0.7);
      for (int i = 0; i < 64; ++i) points.push_back(middle + random_vector(random, block_m));
    }
    const Errors errors = compare(shapes, points, 1.0);
    CAPTURE(block_m);
    CHECK(errors.distance < 2e-6);
    CHECK(errors.wrong_owner == 0);
  }
}

TEST_CASE(
    "a closest point is exact to 2e-6 and on the surface, at aspect ratios to 1:1000 over twelve decades" *
    doctest::test_suite("long")) {
  engine::Random random(4);
  for (int shape = 0; shape < 120; ++shape) {
    Ellipsoid e;
    const double size_m = std::pow(10.0, random.uniform(-6.0, 6.0));
    e.axes = random_rotation(random);
    for (int axis = 0; axis < 3; ++axis) e.radii[axis] = size_m * std::pow(10.0, random.uniform(-3.0, 0.0));
    std::vector<Vec3> points;
    for (int i = 0; i < 4000; ++i) {
      Vec3 p = random.uniform(0.0, 3.0) * random_direction(random);
      // Every other point lies on symmetry planes, where the focal ellipse is.
      for (int axis = 0; i % 2 == 0 && axis < 3; ++axis)
        if (random.below(2) == 0) p[axis] = 0.0;
      points.push_back(e.axes * e.radii.cwiseProduct(p));
    }
    const Errors errors = compare({e}, points, e.radii.maxCoeff());
    CAPTURE(e.radii.transpose());
    // The farthest points are three radii away, and the oracle's ellipsoid is not rounded to 44 bits.
    CHECK(errors.distance < 2e-6);
    CHECK(errors.point < 2e-6);
    CHECK(errors.wrong_owner == 0);
  }
}
