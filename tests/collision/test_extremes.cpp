// The response at the limits of what a scene can hold.
#include <doctest/doctest.h>

#include <numeric>

#include <bodice_test/responses.hpp>

#include "scenes.hpp"

using namespace bodice;
using namespace bodice::collision;
using namespace bodice_test;

namespace {

/// Particles at the center, on the axes, on the symmetry planes and at random points inside of `e`, local
/// frame.
Cloud inside_of(const Ellipsoid& e, const Vec3& origin) {
  engine::Random random(3);
  Cloud cloud;
  for (int i = 0; i < 27; ++i) {
    const Vec3 on_grid(0.4 * (i % 3 - 1), 0.4 * (i / 3 % 3 - 1), 0.4 * (i / 9 - 1));
    cloud.add(e.center + e.axes * e.radii.cwiseProduct(on_grid) - origin);
  }
  for (int i = 0; i < 200; ++i) {
    const Vec3 at = 0.57 * random_vector(random, 1.0);
    cloud.add(e.center + e.axes * e.radii.cwiseProduct(at) - origin);
  }
  return cloud;
}

}  // namespace

TEST_CASE("a response resolves all particles at aspect ratios to 1:1000 and radii from 1e-6 to 1e6 m") {
  engine::Random random(2);
  for (const double scale_m : {1e-6, 1e-3, 1.0, 1e3, 1e6})
    for (const double aspect : {1.0, 10.0, 100.0, 1000.0}) {
      std::vector<Ellipsoid> shapes(2);
      shapes[0].radii = scale_m * Vec3(1.0, 1.0 / std::sqrt(aspect), 1.0 / aspect);
      shapes[1].radii = scale_m * Vec3(1.0 / aspect, 1.0, 1.0);
      shapes[0].axes = random_rotation(random);
      shapes[1].center = 0.5 * scale_m * random_direction(random);
      const Collider collider(proxy_of(shapes));
      for (const Ellipsoid& e : shapes) {
        Cloud cloud = inside_of(e, collider.origin());
        const ContactReport report = collider.resolve({}, cloud.particles(), {});
        double lowest_m = scale_m;
        for (std::size_t i = 0; i < cloud.size(); ++i)
          lowest_m =
              std::min(lowest_m, brute_force(shapes, cloud.position(i) + collider.origin()).signed_distance);
        CAPTURE(scale_m);
        CAPTURE(aspect);
        CHECK(report.unresolved == 0);
        CHECK(lowest_m > -1e-6 * scale_m);
      }
    }
}

TEST_CASE("the certificate of relief is proportional to the body, from a millimeter to a kilometer") {
  for (const double scale : {1e-3, 1.0, 1e3}) {
    auto data = data_of(random_ellipsoids(12, 40, 0.4 * scale, 0.06 * scale, 0.25 * scale));
    data.stature_m *= scale;
    const Collider collider(proxy_of(with_relief(data, 16, 0.003 * scale, 5)));
    engine::Random random(9);
    Cloud cloud;
    for (int i = 0; i < 20000; ++i) cloud.add(random_vector(random, 0.7 * scale));
    const auto thickness_m = static_cast<float>(1e-3 * scale);
    const ContactReport report = collider.resolve({}, cloud.particles(), {.thickness_m = thickness_m});
    std::vector<Contact> contacts(cloud.size());
    collider.query({}, cloud.particles(), contacts);
    std::size_t short_of = 0;
    double lowest = 1.0;
    for (const Contact& c : contacts) {
      const double distance = double{c.signed_distance} / scale;
      lowest = std::min(lowest, distance);
      short_of += distance < 1e-3 - 1e-5;
    }
    CAPTURE(scale);
    CHECK(report.contacts > 1000);
    CHECK(report.fallbacks + report.judged_exactly > 0);
    CHECK(report.unresolved == 0);
    CHECK(lowest > -1e-5);
    CHECK(short_of <= report.pinched);
  }
}

TEST_CASE("a response resolves all particles among 4,096 ellipsoids, apart or identical" *
          doctest::test_suite("long")) {
  const auto one = random_ellipsoids(8, 1, 0.1, 0.1, 0.3)[0];
  for (const auto& shapes : {random_ellipsoids(4, 4096, 1.0, 0.02, 0.1), std::vector<Ellipsoid>(4096, one)}) {
    const Collider collider(proxy_of(shapes));
    engine::Random random(6);
    Cloud cloud;
    for (int i = 0; i < 1000; ++i) cloud.add(random_vector(random, 0.4));
    const ContactReport report = collider.resolve({}, cloud.particles(), {});
    CHECK(report.contacts > 5);
    CHECK(report.unresolved == 0);
    double lowest_m = 1.0;
    for (std::size_t i = 0; i < cloud.size(); ++i)
      lowest_m =
          std::min(lowest_m, brute_force(shapes, cloud.position(i) + collider.origin()).signed_distance);
    CHECK(lowest_m > -1e-6);
  }
}

TEST_CASE("ten million particles get the same response as each of them alone" * doctest::test_suite("long")) {
  constexpr std::size_t kCount = 10'000'000, kPeriod = 1000;
  const auto shapes = random_ellipsoids(7, 10, 0.2, 0.1, 0.2);
  const Collider collider(proxy_of(shapes));
  engine::Random random(6);
  Cloud few;
  for (std::size_t i = 0; i < kPeriod; ++i) few.add(random_vector(random, 0.6));
  std::vector<float> x(kCount), y(kCount), z(kCount);
  for (std::size_t i = 0; i < kCount; ++i) {
    const std::size_t k = i / (kCount / kPeriod);
    x[i] = few.x[k], y[i] = few.y[k], z[i] = few.z[k];
  }
  const Particles all{.count = kCount, .x = x.data(), .y = y.data(), .z = z.data()};
  const ContactReport one = collider.resolve({}, few.particles(), {}), many = collider.resolve({}, all, {});
  CHECK(one.contacts > 50);
  CHECK(many.contacts == one.contacts * (kCount / kPeriod));
  CHECK(many.unresolved == 0);
  double farthest_m = 0.0;
  for (std::size_t i = 0; i < kCount; ++i) {
    const std::size_t k = i / (kCount / kPeriod);
    farthest_m =
        std::max({farthest_m, std::abs(double{x[i]} - double{few.x[k]}),
                  std::abs(double{y[i]} - double{few.y[k]}), std::abs(double{z[i]} - double{few.z[k]})});
  }
  CHECK(farthest_m < 1e-6);
}

TEST_CASE("particles that are not finite are counted and do not affect their neighbors") {
  const auto shapes = random_ellipsoids(7, 10, 0.2, 0.1, 0.2);
  const Collider collider(proxy_of(shapes));
  const float bad[] = {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()};
  engine::Random random(6);
  Cloud cloud, clean;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 p = random_vector(random, 0.3);
    cloud.add(p);
    if (i % 10 != 3) clean.add(p);
    if (i % 10 == 3) (i % 20 == 3 ? cloud.x : cloud.vz).back() = bad[i % 3 == 0];
  }
  const ContactReport report = collider.resolve({}, cloud.particles(), {});
  collider.resolve({}, clean.particles(), {});
  CHECK(report.not_finite == 100);
  std::size_t at = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (i % 10 == 3) continue;
    CHECK((cloud.position(i) - clean.position(at++)).norm() < 1e-6);
  }
}

TEST_CASE("a report counts contacts by part and gives the depth of the deepest") {
  std::vector<Ellipsoid> shapes(3);
  for (std::size_t k = 0; k < 3; ++k) {
    shapes[k].center.x() = static_cast<double>(k);
    shapes[k].radii.setConstant(0.2);
  }
  const Collider collider(proxy_of(shapes));
  Cloud cloud;
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i <= k; ++i) cloud.add(Vec3(k, 0.15 + 0.01 * i, 0.0) - collider.origin());
  const ContactReport report = collider.resolve({}, cloud.particles(), {});
  CHECK(report.contacts == 6);
  for (int k = 0; k < 3; ++k) CHECK(report.contacts_by_part[k] == static_cast<std::uint64_t>(k + 1));
  CHECK(std::accumulate(std::begin(report.contacts_by_part), std::end(report.contacts_by_part), 0u) == 6u);
  CHECK(report.deepest_m == doctest::Approx(0.05).epsilon(1e-4));
  CHECK(report.max_iterations >= 1);
}

TEST_CASE("a response leaves none of 200,000 random particles inside, among thin or thick ellipsoids") {
  for (const std::uint64_t seed : {1u, 2u})
    for (const bool shell : {false, true}) {
      const auto shapes =
          shell ? random_ellipsoids(seed, 60, 0.5, 0.01, 0.15) : random_ellipsoids(seed, 30, 0.3, 0.1, 0.3);
      const Collider collider(proxy_of(shapes));
      engine::Random random(seed);
      Cloud cloud;
      for (int i = 0; i < 50000; ++i) cloud.add(random_vector(random, 0.7));
      const ContactReport report = collider.resolve({}, cloud.particles(), {});
      CHECK(report.unresolved == 0);
      CHECK(report.pinched == 0);
      int inside = 0;
      for (std::size_t i = 0; i < cloud.size(); ++i) {
        const Vec3 p = cloud.position(i) + collider.origin();
        for (const Ellipsoid& e : shapes)
          inside += geometry::level(e, p) < 1.0 && geometry::closest_point(e, p).signed_distance < -1e-6;
      }
      CHECK(inside == 0);
    }
}

TEST_CASE("velocities and safe positions count only if all three of their arrays are given") {
  const auto shapes = limb();
  const Collider collider(proxy_of(shapes));
  engine::Random random(9);
  Cloud cloud;
  for (int i = 0; i < 500; ++i) {
    const Vec3 at = random_vector(random, 0.1);
    cloud.add(at, random_vector(random, 1.0));
    cloud.add_safe(at + random_vector(random, 0.1));
  }
  Cloud positions_only = cloud;
  Particles bare = positions_only.particles();
  bare.vx = bare.vy = bare.vz = nullptr;
  bare.safe_x = bare.safe_y = bare.safe_z = nullptr;
  collider.resolve({}, bare, {});
  std::vector<Contact> contacts(cloud.size());
  for (int given = 1; given < 7; ++given) {
    for (const auto& [name, response] : bodice_test::kResponses) {
      CAPTURE(name);
      Cloud now = cloud;
      Particles some = now.particles();
      if (!(given & 1)) some.vx = nullptr, some.safe_x = nullptr;
      if (!(given & 2)) some.vy = nullptr, some.safe_y = nullptr;
      if (!(given & 4)) some.vz = nullptr, some.safe_z = nullptr;
      collider.query({}, some, contacts);
      const ContactReport report = collider.resolve({}, some, {.response = response});
      CHECK(report.contacts > 0);
      CHECK(now.vx == cloud.vx);
      CHECK(now.vy == cloud.vy);
      CHECK(now.vz == cloud.vz);
      if (response == Response::kClosestPoint) {
        CHECK(now.x == positions_only.x);
        CHECK(now.y == positions_only.y);
        CHECK(now.z == positions_only.z);
      }
    }
  }
}

TEST_CASE("particles without an array of positions have no owner, and a response counts them as not finite") {
  const Collider collider(proxy_of(limb()));
  Cloud cloud;
  for (int i = 0; i < 300; ++i) cloud.add(Vec3::Zero());
  const Cloud before = cloud;
  for (int missing = 1; missing < 8; ++missing) {
    Particles some = cloud.particles();
    if (missing & 1) some.x = nullptr;
    if (missing & 2) some.y = nullptr;
    if (missing & 4) some.z = nullptr;
    std::vector<Contact> contacts(cloud.size());
    Workspace workspace;
    collider.query({}, some, contacts);
    for (const Contact& contact : contacts) CHECK(contact.ellipsoid == kNoEllipsoid);
    contacts.assign(cloud.size(), Contact{});
    collider.query({}, some, contacts, workspace);
    for (const Contact& contact : contacts) CHECK(contact.ellipsoid == kNoEllipsoid);
    const ContactReport report = collider.resolve({}, some, {}, workspace);
    CHECK(report.not_finite == cloud.size());
    CHECK(report.contacts == 0);
  }
  CHECK(cloud.x == before.x);
  CHECK(cloud.y == before.y);
  CHECK(cloud.z == before.z);
}
