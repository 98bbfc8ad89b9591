#include <doctest/doctest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <span>
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

std::vector<Vec3> points_around(std::uint64_t seed, int count, double half_side) {
  engine::Random random(seed);
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) points.push_back(random_vector(random, half_side));
  return points;
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

TEST_CASE("a query finds the nearer of two ellipsoids next to a crease, on every instruction set") {
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

TEST_CASE("a query agrees with brute force for 700 different ellipsoids around one point") {
  const auto shapes = random_ellipsoids(5, 700, 0.05, 0.08, 0.1);
  const Errors errors = compare(shapes, points_around(3, 3000, 0.2), 0.2);
  CHECK(errors.distance < 2e-6);
  CHECK(errors.wrong_owner == 0);
}

TEST_CASE("distances ten kilometers from the origin are those at the origin to 2 micrometers") {
  auto shapes = random_ellipsoids(3, 40, 0.6, 0.03, 0.2);
  const Collider near(proxy_of(shapes));
  const Vec3 away(10'000.0, 0.0, -10'000.0);
  for (Ellipsoid& e : shapes) e.center += away;
  const Collider far(proxy_of(shapes));
  engine::Random random(1);
  double worst_m = 0.0;
  for (int i = 0; i < 3000; ++i) {
    const Vec3 p = random_vector(random, 1.0);
    const Vec3 a = p - near.origin(), b = p + away - far.origin();
    const Contact at_origin = near.query({float(a.x()), float(a.y()), float(a.z())});
    const Contact at_distance = far.query({float(b.x()), float(b.y()), float(b.z())});
    worst_m =
        std::max(worst_m, std::abs(double{at_origin.signed_distance} - double{at_distance.signed_distance}));
  }
  CHECK(worst_m < 2e-6);
}

TEST_CASE("queries and responses accept no ellipsoids, no particles, and particles that are not finite") {
  const Collider empty(proxy_of(std::vector<Ellipsoid>{}));
  const float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  CHECK(empty.query({0, 0, 0}).ellipsoid == kNoEllipsoid);
  CHECK(empty.query({0, 0, 0}).signed_distance == inf);
  const Collider one(proxy_of(random_ellipsoids(2, 1, 0.1, 0.1, 0.3)));
  CHECK(one.query({nan, 0, 0}).ellipsoid == kNoEllipsoid);
  CHECK(one.query({0, -inf, 0}).ellipsoid == kNoEllipsoid);
  CHECK(one.query({3e38f, 3e38f, 3e38f}).ellipsoid == 0);
  CHECK(std::isfinite(one.query({1e20f, 0, 0}).signed_distance));
  one.query({}, Particles{}, {});
  Cloud cloud;
  for (int i = 0; i < 100; ++i) cloud.add(Vec3(0.01 * i, 0, 0));
  cloud.x[3] = nan;
  cloud.z[77] = inf;
  const Cloud before = cloud;
  CHECK(empty.resolve({}, cloud.particles(), {}).not_finite == 2);
  const ContactReport report = one.resolve({}, cloud.particles(), {});
  CHECK(report.not_finite == 2);
  CHECK(std::isnan(cloud.x[3]));
  CHECK(cloud.y[3] == before.y[3]);
  CHECK(cloud.z[77] == inf);
  std::vector<Contact> contacts(100);
  one.query({}, cloud.particles(), contacts);
  CHECK(contacts[3].ellipsoid == kNoEllipsoid);
  CHECK(contacts[4].ellipsoid == 0);
}

TEST_CASE("query_all returns contacts nearest first, each with the distance of its own ellipsoid") {
  const auto shapes = random_ellipsoids(3, 30, 0.3, 0.1, 0.3);
  const Collider collider(proxy_of(shapes));
  engine::Random random(2);
  for (int i = 0; i < 200; ++i) {
    const Vec3 p = random_vector(random, 0.4), local = p - collider.origin();
    std::vector<Contact> contacts(4);
    const std::size_t found =
        collider.query_all({float(local.x()), float(local.y()), float(local.z())}, 0.02f, contacts);
    std::vector<double> truth;
    for (const Ellipsoid& e : shapes) truth.push_back(geometry::closest_point(e, p).signed_distance);
    const auto within = std::count_if(truth.begin(), truth.end(), [](double d) { return d <= 0.02; });
    CHECK(found == static_cast<std::size_t>(within));
    std::sort(truth.begin(), truth.end());
    for (std::size_t k = 0; k < std::min<std::size_t>(found, 4); ++k)
      CHECK(double{contacts[k].signed_distance} == doctest::Approx(truth[k]).epsilon(1e-5).scale(1.0));
  }
}

TEST_CASE("relief distances and normals agree with proxy_distance(), which defines them") {
  struct Case {
    int nodes;
    bool sorted_axes;  ///< by falling radius: the kernels read such tables by another code path
  };
  for (const auto& [nodes, sorted_axes] :
       {Case{2, false}, Case{5, false}, Case{16, false}, Case{16, true}, Case{33, false}, Case{33, true}}) {
    auto shapes = random_ellipsoids(8, 60, 0.5, 0.04, 0.2);
    if (sorted_axes)
      for (Ellipsoid& e : shapes) std::sort(e.radii.begin(), e.radii.end(), std::greater<>());
    const auto proxy = proxy_of(with_relief(data_of(shapes), nodes, 0.004, 77));
    const Collider collider(proxy);
    engine::Random random(3);
    Cloud cloud;
    for (int i = 0; i < 20000; ++i) cloud.add(random_vector(random, 0.8));
    std::vector<Contact> contacts(cloud.size());
    collider.query({}, cloud.particles(), contacts);
    double worst_m = 0.0, worst_cosine = 1.0;
    int off_normals = 0;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const auto truth = proxy::proxy_distance(proxy, cloud.position(i) + collider.origin());
      worst_m = std::max(worst_m, std::abs(truth.distance - double{contacts[i].signed_distance}));
      const float* n = contacts[i].normal;
      const double cosine = truth.normal.dot(Vec3(double{n[0]}, double{n[1]}, double{n[2]}));
      worst_cosine = std::min(worst_cosine, cosine);
      // The gradient jumps where cells or octants of a table meet, and rounding may choose the other side.
      off_normals += cosine < 0.9999;
    }
    CAPTURE(nodes);
    CAPTURE(sorted_axes);
    // The bar is a hundredth of a millimeter: where owners blend over 3 mm, an error of the distance counts
    // eightfold.
    CHECK(worst_m < 1e-5);
    CHECK(off_normals < 60);
  }
}

TEST_CASE("ellipsoids without a relief table are plain beside others that have one") {
  const auto shapes = random_ellipsoids(9, 40, 0.4, 0.05, 0.2);
  auto data = with_relief(data_of(shapes), 8, 0.003, 12);
  for (std::size_t k = 0; k < data.relief.size(); k += 3) data.relief[k] = {};
  const auto proxy = proxy_of(data);
  const Collider collider(proxy);
  engine::Random random(3);
  Cloud cloud;
  for (int i = 0; i < 20000; ++i) cloud.add(random_vector(random, 0.7));
  std::vector<Contact> contacts(cloud.size());
  collider.query({}, cloud.particles(), contacts);
  const Cloud before = cloud;
  const ContactReport report = collider.resolve({}, cloud.particles(), {});
  double worst_m = 0.0, lowest_m = 1.0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const double truth = proxy::proxy_distance(proxy, before.position(i) + collider.origin()).distance;
    worst_m = std::max(worst_m, std::abs(truth - double{contacts[i].signed_distance}));
    lowest_m =
        std::min(lowest_m, proxy::proxy_distance(proxy, cloud.position(i) + collider.origin()).distance);
  }
  CHECK(worst_m < 1e-5);
  CHECK(report.contacts > 1000);
  CHECK(report.unresolved == 0);
  CHECK(lowest_m > -5e-5);
}

TEST_CASE("a query agrees with brute force for blocks from a tenth of a millimeter to half a meter") {
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

TEST_CASE("a particle far away does not change the results of its neighbors in the block") {
  constexpr int kBlockParticles = 64;
  const proxy::BodyProxy proxy = proxy_of(random_ellipsoids(13, 120, 0.6, 0.03, 0.2));
  const Collider collider(proxy);
  engine::Random random(29);
  double worst_m = 0.0, lowest_m = 1.0;
  for (int block = 0; block < 200; ++block) {
    Cloud cloud;
    cloud.add(std::pow(10.0, random.uniform(2.0, 8.0)) * random_direction(random));
    while (cloud.size() < kBlockParticles) cloud.add(random_vector(random, 0.7));
    const Cloud before = cloud;
    std::vector<Contact> contacts(cloud.size());
    collider.query({}, cloud.particles(), contacts);
    Cloud filleted = before;
    collider.resolve({}, cloud.particles(), {});
    collider.resolve({}, filleted.particles(), {.blend_m = 0.01f});
    for (std::size_t i = 1; i < kBlockParticles; ++i) {
      const double truth = proxy::proxy_distance(proxy, before.position(i) + collider.origin()).distance;
      worst_m = std::max(worst_m, std::abs(truth - double{contacts[i].signed_distance}));
      for (const Cloud* out : {&cloud, &filleted})
        lowest_m =
            std::min(lowest_m, proxy::proxy_distance(proxy, out->position(i) + collider.origin()).distance);
    }
  }
  CHECK(worst_m < 2e-6);
  CHECK(lowest_m > -2e-6);
}

TEST_CASE(
    "a closest point is exact to 2e-6 and on the surface, at aspect ratios to 1:1000 over twelve decades") {
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

TEST_CASE("with fewer contacts than particles only so many particles are queried") {
  const auto shapes = random_ellipsoids(3, 20, 0.8, 0.02, 0.2);
  const Collider collider(proxy_of(shapes));
  Cloud cloud;
  for (const Vec3& p : points_around(6, 1000, 1.2)) cloud.add(p - collider.origin());
  std::vector<Contact> all(cloud.size()), some(cloud.size());
  collider.query({}, cloud.particles(), all);
  for (const std::size_t room : {std::size_t{0}, std::size_t{1}, std::size_t{300}, std::size_t{999}}) {
    Contact untouched;
    untouched.signed_distance = -77.0f;
    std::ranges::fill(some, untouched);
    collider.query({}, cloud.particles(), std::span(some).first(room));
    for (std::size_t i = 0; i < some.size(); ++i)
      CHECK(some[i].signed_distance == (i < room ? all[i].signed_distance : -77.0f));
  }
}

TEST_CASE("an invalid pose is rejected, and the proxy stays where it was") {
  const auto shapes = random_ellipsoids(4, 5, 0.8, 0.02, 0.2);
  Collider collider(proxy_of(shapes));
  CHECK(collider.proxy_hash() == proxy_of(shapes).hash());
  const auto distance = [&] { return collider.query({0.1f, 0.2f, 0.3f}).signed_distance; };
  const float before = distance();
  auto moved = shapes;
  for (Ellipsoid& e : moved) e.center.x() += 0.5;
  CHECK_FALSE(collider.move_to(std::span(moved).first(4), 0.01));
  auto bad = moved;
  bad[2].center.y() = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(collider.move_to(bad, 0.01));
  bad = moved;
  bad[4].radii.z() = 0.0;
  CHECK_FALSE(collider.move_to(bad, 0.01));
  bad = moved;
  bad[1].axes(0, 1) += 0.1;  // shear
  CHECK_FALSE(collider.move_to(bad, 0.01));
  bad = moved;
  bad[0].axes.col(1) *= -1.0;
  CHECK_FALSE(collider.move_to(bad, 0.01));
  CHECK(distance() == before);
  CHECK(collider.move_to(moved, 0.01));
  CHECK(distance() != before);
}
