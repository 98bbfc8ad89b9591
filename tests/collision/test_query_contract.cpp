#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

#include "scenes.hpp"

using namespace bodice;
using namespace bodice::collision;
using namespace bodice_test;

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
