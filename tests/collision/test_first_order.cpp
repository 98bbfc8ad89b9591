// Accuracy::kFirstOrder: which errors its results may have, and which not.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>

#include <bodice_test/executors.hpp>
#include <bodice_test/targets.hpp>
#include "scenes.hpp"

using namespace bodice;
using namespace bodice::collision;
using namespace bodice_test;

namespace {

constexpr QueryOptions kFirst{.accuracy = Accuracy::kFirstOrder};

Vec3 vec(const float (&v)[3]) {
  return {double{v[0]}, double{v[1]}, double{v[2]}};
}

/// Ellipsoids in random orientations: a ball, limbs, plates and a needle.
std::vector<Ellipsoid> shapes_alone() {
  engine::Random random(11);
  std::vector<Ellipsoid> result;
  for (const Vec3& radii : {Vec3(0.1, 0.1, 0.1), Vec3(0.05, 0.06, 0.2), Vec3(0.2, 0.05, 0.15),
                            Vec3(0.02, 0.2, 0.2), Vec3(0.3, 0.01, 0.02)}) {
    Ellipsoid e;
    e.center = random_vector(random, 0.2);
    e.axes = random_rotation(random);
    e.radii = radii;
    result.push_back(e);
  }
  return result;
}

/// The point off the surface by `height_m` along the normal.
Vec3 above(const Ellipsoid& e, const Vec3& direction, double height_m) {
  const Vec3 normal = direction.cwiseQuotient(e.radii).normalized();
  return e.center + e.axes * (direction.cwiseProduct(e.radii) + height_m * normal);
}

/// Height of the point over the ellipsoid's tangent plane that has this outward normal.
double over_tangent_plane(const Ellipsoid& e, const Vec3& p, const Vec3& normal) {
  const Vec3 n = e.axes.transpose() * normal;
  return normal.dot(p - e.center) - n.cwiseProduct(e.radii).norm();
}

/// A proxy of overlapping ellipsoids of the proportions of a body's.
proxy::BodyProxy body_like(bool relief, double margin_m = 0.0) {
  auto data = data_of(random_ellipsoids(31, 60, 0.5, 0.05, 0.15));
  data.margin_m = margin_m;
  return proxy_of(relief ? with_relief(data, 16, 0.004, 3) : data);
}

/// Random particles within `band_m` of the surface.
Cloud near_surface(const Collider& collider, int count, float band_m) {
  engine::Random random(5);
  Cloud cloud;
  while (cloud.size() < static_cast<std::size_t>(count)) {
    const Vec3 p = random_vector(random, 0.7);
    const float at[3] = {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
    if (std::abs(collider.query(at).signed_distance) < band_m) cloud.add(p);
  }
  return cloud;
}

std::vector<Contact> contacts_of(const Collider& collider, Cloud& cloud, const QueryOptions& options) {
  std::vector<Contact> contacts(cloud.size());
  collider.query({}, cloud.particles(), contacts, options);
  return contacts;
}

/// Root mean square of the distance's error at a height, in units of the shortest radius.
double rms_error(const Ellipsoid& e, double height) {
  const Collider collider(proxy_of({e}));
  engine::Random random(3);
  Cloud cloud;
  constexpr int kPoints = 512;
  for (int i = 0; i < kPoints; ++i) {
    // The position is rounded to float before the truth is computed, so that rounding is not measured.
    const Vec3 p = above(e, random_direction(random), height * e.radii.minCoeff());
    cloud.add(p - collider.origin());
  }
  const auto contacts = contacts_of(collider, cloud, kFirst);
  double sum = 0.0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const auto truth = geometry::closest_point(e, cloud.position(i) + collider.origin()).signed_distance;
    const double off = truth - double{contacts[i].signed_distance};
    sum += off * off;
  }
  return std::sqrt(sum / kPoints);
}

}  // namespace

TEST_CASE("a first-order distance is that to a tangent plane of the ellipsoid, on every instruction set") {
  for (const Ellipsoid& e : shapes_alone()) {
    const Collider collider(proxy_of({e}));
    engine::Random random(7);
    Cloud cloud;
    std::vector<double> heights;
    for (int i = 0; i < 1000; ++i) {
      heights.push_back(random.uniform(-0.9, 3.0) * e.radii.minCoeff());
      cloud.add(above(e, random_direction(random), heights.back()) - collider.origin());
    }
    const double tolerance_m = 2e-6 * (e.radii.maxCoeff() + 0.2);
    on_every_target([&](const std::string& name) {
      CAPTURE(name);
      const auto contacts = contacts_of(collider, cloud, kFirst);
      double off_plane_m = 0.0, above_truth_m = -1.0, off_point_m = 0.0, off_unit = 0.0;
      int wrong_sides = 0;
      for (std::size_t i = 0; i < cloud.size(); ++i) {
        const Vec3 p = cloud.position(i) + collider.origin(), n = vec(contacts[i].normal);
        const double found = double{contacts[i].signed_distance};
        const double truth = geometry::closest_point(e, p).signed_distance;
        off_plane_m = std::max(off_plane_m, std::abs(found - over_tangent_plane(e, p, n.normalized())));
        above_truth_m = std::max(above_truth_m, found - truth);
        wrong_sides += std::abs(truth) > tolerance_m && (found < 0.0) != (truth < 0.0);
        off_point_m = std::max(off_point_m, (cloud.position(i) - found * n - vec(contacts[i].point)).norm());
        off_unit = std::max(off_unit, std::abs(n.norm() - 1.0));
      }
      CHECK(off_plane_m < tolerance_m);
      CHECK(above_truth_m < tolerance_m);
      CHECK(wrong_sides == 0);
      CHECK(off_point_m < tolerance_m);
      CHECK(off_unit < 1e-6);
    });
  }
}

TEST_CASE("the error of a first-order distance grows with the fourth power of the height") {
  for (const Ellipsoid& e : shapes_alone()) {
    if (e.radii.maxCoeff() == e.radii.minCoeff()) {
      CHECK(rms_error(e, 0.5) < 1e-6 * e.radii.maxCoeff());  // a ball has no error
      continue;
    }
    // The tips of longer shapes have radii of curvature below such heights, and float precision does not
    // suffice.
    if (e.radii.maxCoeff() > 4.0 * e.radii.minCoeff()) continue;
    CAPTURE(e.radii.transpose());
    CHECK(rms_error(e, 0.2) > 10.0 * rms_error(e, 0.1));
    CHECK(rms_error(e, -0.2) > 10.0 * rms_error(e, -0.1));
  }
}

TEST_CASE("at a center the first-order normal is along the shortest axis") {
  for (const Ellipsoid& e : shapes_alone()) {
    const Collider collider(proxy_of({e}));
    const Vec3 center = e.center - collider.origin();
    const Contact contact = collider.query(
        {static_cast<float>(center.x()), static_cast<float>(center.y()), static_cast<float>(center.z())},
        kFirst);
    int shortest = 0;
    e.radii.minCoeff(&shortest);
    // The center may not be a float, but the exit from a point next to it is as long.
    CHECK(double{contact.signed_distance} == doctest::Approx(-e.radii.minCoeff()).epsilon(1e-3));
    if (e.radii[(shortest + 1) % 3] > e.radii[shortest] && e.radii[(shortest + 2) % 3] > e.radii[shortest])
      CHECK(std::abs(vec(contact.normal).dot(e.axes.col(shortest))) == doctest::Approx(1.0).epsilon(1e-3));
  }
}

TEST_CASE("first-order distances of a union have the exact sign, and few particles get a wrong owner" *
          doctest::test_suite("long")) {
  const auto proxy = body_like(false);
  std::vector<Ellipsoid> shapes;
  for (const auto& e : proxy.ellipsoids()) shapes.push_back(e.shape);
  const Collider collider(proxy);
  Cloud cloud = near_surface(collider, 6000, 0.01f);
  on_every_target([&](const std::string& name) {
    CAPTURE(name);
    const auto contacts = contacts_of(collider, cloud, kFirst);
    int wrong_sides = 0, wrong_owners = 0, above_owner = 0;
    double sum_m = 0.0;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      std::uint32_t owner = 0;
      const Vec3 p = cloud.position(i) + collider.origin();
      const double truth = brute_force(shapes, p, &owner).signed_distance;
      const double found = double{contacts[i].signed_distance};
      wrong_sides += std::abs(truth) > 1e-6 && (found < 0.0) != (truth < 0.0);
      wrong_owners += contacts[i].ellipsoid != owner;
      above_owner += found > geometry::closest_point(shapes[contacts[i].ellipsoid], p).signed_distance + 1e-6;
      sum_m += std::abs(found - truth);
    }
    CHECK(wrong_sides == 0);
    CHECK(above_owner == 0);
    CHECK(wrong_owners < 60);
    CHECK(sum_m / static_cast<double>(cloud.size()) < 5e-5);
  });
}

TEST_CASE("first-order relief is exact on single balls and close on other single ellipsoids") {
  for (const Ellipsoid& e : shapes_alone()) {
    const bool round = e.radii.maxCoeff() == e.radii.minCoeff();
    const double height = round ? 0.05 : 0.02;
    const Collider collider(proxy_of(with_relief(data_of({e}), 12, 0.003, 9)));
    REQUIRE(collider.has_relief());
    engine::Random random(13);
    Cloud cloud;
    for (int i = 0; i < 2000; ++i)
      cloud.add(above(e, random_direction(random), random.uniform(-height, height) * e.radii.minCoeff()) -
                collider.origin());
    const auto exact = contacts_of(collider, cloud, {}), first = contacts_of(collider, cloud, kFirst);
    double worst_m = 0.0;
    std::vector<double> cosines;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      worst_m = std::max(worst_m, double{std::abs(exact[i].signed_distance - first[i].signed_distance)});
      cosines.push_back(vec(exact[i].normal).dot(vec(first[i].normal)));
    }
    std::sort(cosines.begin(), cosines.end());
    CAPTURE(e.radii.transpose());
    CHECK(worst_m < (round ? 2e-6 : 1e-4));
    // The gradient jumps at the borders of a table's cells, and a few points lie on the other side.
    CHECK(cosines[cosines.size() / 50] > (round ? 0.999999 : 0.999));
  }
}

TEST_CASE("a first-order query with a contact distance reports only particles within it" *
          doctest::test_suite("long")) {
  for (const bool relief : {false, true})
    for (const double margin_m : {0.0, 0.003}) {
      const Collider collider(body_like(relief, margin_m));
      Cloud cloud = near_surface(collider, 4000, 0.03f);
      const auto unlimited = contacts_of(collider, cloud, kFirst);
      for (const float within_m : {-0.01f, 0.0f, 0.01f, -kInf}) {
        const auto limited =
            contacts_of(collider, cloud, {.within_m = within_m, .accuracy = Accuracy::kFirstOrder});
        int too_far = 0, found = 0, differ = 0;
        for (std::size_t i = 0; i < cloud.size(); ++i) {
          const bool none = limited[i].ellipsoid == kNoEllipsoid;
          found += !none;
          too_far += !none && !(limited[i].signed_distance <= within_m);
          differ += none == (unlimited[i].signed_distance <= within_m);
          if (none) CHECK(limited[i].signed_distance == kInf);
        }
        CHECK(too_far == 0);
        CHECK((found > 100 || within_m == -kInf));
        // With fewer candidates another of two nearly equal owners may be chosen.
        CHECK(differ <= (within_m == 0.0f && !relief ? 0 : 8));
      }
    }
}

TEST_CASE("first-order queries give the same bits for any number of workers, with and without a workspace" *
          doctest::test_suite("long")) {
  for (const bool relief : {false, true}) {
    const Collider collider(body_like(relief));
    Cloud cloud = near_surface(collider, 7001, 0.03f);
    cloud.x[17] = std::numeric_limits<float>::quiet_NaN();
    cloud.y[4000] = 1e20f;
    const auto executor = bodice_test::make_threads(3);
    std::vector<Contact> alone(cloud.size()), shared(cloud.size());
    Workspace of_one, of_three;
    for (int call = 0; call < 12; ++call) {
      for (float& x : cloud.x) x += 7e-4f;
      collider.query({}, cloud.particles(), alone, of_one, kFirst);
      collider.query({.executor = executor.get()}, cloud.particles(), shared, of_three, kFirst);
      CHECK(std::memcmp(alone.data(), shared.data(), alone.size() * sizeof(Contact)) == 0);
      collider.query({}, cloud.particles(), alone, kFirst);
      collider.query({.executor = executor.get()}, cloud.particles(), shared, kFirst);
      CHECK(std::memcmp(alone.data(), shared.data(), alone.size() * sizeof(Contact)) == 0);
      CHECK(alone[17].ellipsoid == kNoEllipsoid);
      CHECK(alone[4000].signed_distance > 1e19f);
    }
  }
}

TEST_CASE("a first-order query never takes an ellipsoid beyond the range of floats for the nearest") {
  // The speck is inside the ball, so that it is never the nearest. The particles surround it, so that no box
  // excludes it.
  std::vector<Ellipsoid> shapes{ball(1.0)[0], ball(1e-8)[0]};
  shapes[1].center.x() = 0.5;
  const Collider collider(proxy_of(shapes));
  engine::Random random(19);
  Cloud cloud;
  for (int i = 0; i < 256; ++i) cloud.add(1e4 * random_direction(random));
  on_every_target([&](const std::string& name) {
    CAPTURE(name);
    int wrong_owners = 0;
    for (const Contact& contact : contacts_of(collider, cloud, kFirst))
      wrong_owners += contact.ellipsoid != 0;
    CHECK(wrong_owners == 0);
  });
}

TEST_CASE("first-order queries with a workspace keep the exact sign while particles and body move" *
          doctest::test_suite("long")) {
  auto shapes = random_ellipsoids(31, 60, 0.5, 0.05, 0.15);
  Collider collider(proxy_of(shapes));
  Cloud cloud = near_surface(collider, 3000, 0.01f);
  Workspace workspace;
  std::vector<Contact> cached(cloud.size());
  for (int call = 0; call < 30; ++call) {
    for (float& y : cloud.y) y += 5e-4f;
    for (Ellipsoid& e : shapes) e.center.x() += 3e-4;
    REQUIRE(collider.move_to(shapes, 1.0 / 60.0));
    collider.query({}, cloud.particles(), cached, workspace, kFirst);
    const auto exact = contacts_of(collider, cloud, {});
    int wrong_sides = 0, wrong_owners = 0;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      wrong_sides += std::abs(exact[i].signed_distance) > 1e-6f &&
                     (exact[i].signed_distance < 0.0f) != (cached[i].signed_distance < 0.0f);
      wrong_owners += exact[i].ellipsoid != cached[i].ellipsoid;
    }
    CHECK(wrong_sides == 0);
    CHECK(wrong_owners < 90);
  }
}

TEST_CASE("first-order queries that share a workspace change no bit of exact ones") {
  // The particles move straight from one ball to the other, so that a candidate just outside the cache comes
  // as near as possible.
  std::vector<Ellipsoid> two(2, ball(0.1)[0]);
  two[0].center.x() = -0.2;
  two[1].center.x() = 0.2;
  for (const bool relief : {false, true}) {
    const Collider collider(proxy_of(relief ? with_relief(data_of(two), 8, 0.002, 4) : data_of(two)));
    engine::Random random(17);
    Cloud cloud;
    for (int i = 0; i < 2000; ++i)
      cloud.add({random.uniform(-0.06, 0.01), random.uniform(-0.01, 0.01), random.uniform(-0.01, 0.01)});
    Workspace workspace;
    std::vector<Contact> cached(cloud.size());
    for (int call = 0; call < 60; ++call) {
      for (float& x : cloud.x) x += 5e-4f;
      collider.query({}, cloud.particles(), cached, workspace, kFirst);
      collider.query({}, cloud.particles(), cached, workspace);
      const auto fresh = contacts_of(collider, cloud, {});
      CHECK(std::memcmp(cached.data(), fresh.data(), cached.size() * sizeof(Contact)) == 0);
    }
  }
}

TEST_CASE(
    "first-order queries keep the exact sign when candidates overflow, and report none without ellipsoids") {
  const Collider none(proxy_of(std::vector<Ellipsoid>{}));
  CHECK(none.query({0.0f, 0.0f, 0.0f}, kFirst).ellipsoid == kNoEllipsoid);
  const auto shapes = random_ellipsoids(5, 700, 0.05, 0.08, 0.1);
  const Collider collider(proxy_of(shapes));
  engine::Random random(3);
  Cloud cloud;
  for (int i = 0; i < 600; ++i) cloud.add(random_vector(random, 0.2));
  const auto contacts = contacts_of(collider, cloud, kFirst), exact = contacts_of(collider, cloud, {});
  int wrong_sides = 0;
  double worst_m = 0.0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    wrong_sides += (contacts[i].signed_distance < 0.0f) != (exact[i].signed_distance < 0.0f);
    worst_m = std::max(worst_m, double{std::abs(contacts[i].signed_distance - exact[i].signed_distance)});
  }
  CHECK(wrong_sides == 0);
  CHECK(worst_m < 0.02);
}
