// Collider::cover(): relief rises where points of the skin are outside of the surface.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <vector>

#include <bodice_test/allocations.hpp>
#include <bodice_test/executors.hpp>

#include "scenes.hpp"

using namespace bodice;
using namespace bodice::collision;
using namespace bodice_test;

namespace {

constexpr double kSwelling_m = 0.004, kSwollenRadius_m = 0.08;
constexpr float kTolerance_m = 0.5e-3f;
/// A step of the tables' heights, which are kept in bytes, while they rise by some millimeters.
constexpr double kStep_m = 0.1e-3;

proxy::BodyProxy scene() {
  return proxy_of(with_relief(data_of(random_ellipsoids(31, 40, 0.4, 0.06, 0.2)), 24, 0.002, 3));
}

Cloud around(std::uint64_t seed, int count) {
  Cloud cloud;
  for (const Vec3& p : points_around(seed, count, 0.6)) cloud.add(p);
  return cloud;
}

std::vector<Contact> contacts_at(const Collider& collider, Cloud& cloud, float within_m = kInf) {
  std::vector<Contact> contacts(cloud.size());
  collider.query({}, cloud.particles(), contacts, {.within_m = within_m});
  return contacts;
}

double distance_at(const Collider& collider, const Vec3& world) {
  const Eigen::Vector3f p = (world - collider.origin()).cast<float>();
  return double{collider.query({p.x(), p.y(), p.z()}).signed_distance};
}

/// A skin on the surface that swells by kSwelling_m around one of its points.
struct Skin {
  std::vector<Vec3> points;
  Vec3 swollen = Vec3::Zero();
};

Skin swollen_skin(const Collider& collider) {
  Skin skin;
  Cloud cloud = around(5, 40000);
  for (int step = 0; step < 20; ++step) {  // along the gradient to the surface
    const auto contacts = contacts_at(collider, cloud);
    for (std::size_t i = 0; i < cloud.size(); ++i)
      cloud.x[i] = contacts[i].point[0], cloud.y[i] = contacts[i].point[1], cloud.z[i] = contacts[i].point[2];
  }
  const auto contacts = contacts_at(collider, cloud);
  skin.swollen = cloud.position(0) + collider.origin();
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (std::abs(contacts[i].signed_distance) > 1e-5f) continue;  // in a crease the steps do not end
    const Vec3 normal(double{contacts[i].normal[0]}, double{contacts[i].normal[1]},
                      double{contacts[i].normal[2]});
    const Vec3 at = cloud.position(i) + collider.origin();
    const bool swells = (at - skin.swollen).norm() < kSwollenRadius_m;
    skin.points.push_back(at + (swells ? kSwelling_m : -kSwelling_m) * normal);
  }
  return skin;
}

}  // namespace

TEST_CASE("a cover reaches the skin where it is outside, and changes nothing elsewhere") {
  Collider collider(scene());
  const Skin skin = swollen_skin(collider);
  REQUIRE(skin.points.size() > 20000);
  Cloud cloud = around(8, 20000);
  const auto before = contacts_at(collider, cloud);
  const CoverReport report = collider.cover({}, skin.points, {.tolerance_m = kTolerance_m});
  CHECK(report.uncovered > 50);
  CHECK(report.farthest_m > 0.9 * kSwelling_m);
  CHECK(report.left <= report.uncovered / 100);
  CHECK(report.left_m < 2.0f * kTolerance_m);
  std::size_t outside = 0;
  for (const Vec3& point : skin.points) outside += distance_at(collider, point) > double{kTolerance_m};
  CHECK(outside <= report.left);
  const auto after = contacts_at(collider, cloud);
  std::size_t nearer = 0;
  double higher_m = 0.0, changed_far_m = 0.0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const double fall_m = double{before[i].signed_distance} - double{after[i].signed_distance};
    const double off_m = (cloud.position(i) + collider.origin() - skin.swollen).norm();
    higher_m = std::max(higher_m, -fall_m);
    // Two ellipsoids' radii away no table has a direction of the swelling.
    if (off_m > 0.5) changed_far_m = std::max(changed_far_m, std::abs(fall_m));
    nearer += off_m < 0.05 && fall_m > 0.5 * kSwelling_m;
  }
  CHECK(higher_m < kStep_m);
  CHECK(changed_far_m < kStep_m);
  CHECK(nearer > 0);
}

TEST_CASE("a cover counts the points in any of many boxes") {
  const auto proxy = scene();
  const Skin skin = swollen_skin(Collider(proxy));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  // Slices of the swelling with gaps between them, beside boxes that have no point.
  std::vector<geometry::Box> boxes(20);
  boxes.push_back({Vec3::Constant(nan), Vec3::Constant(nan)});
  constexpr int kSlices = 50;
  constexpr double kThick_m = 2.0 * kSwollenRadius_m / kSlices;
  const Vec3 low = skin.swollen - Vec3::Constant(kSwollenRadius_m);
  for (int k = 0; k < kSlices; k += 2)
    boxes.push_back({low + Vec3(k * kThick_m, 0.0, 0.0),
                     low + Vec3((k + 1) * kThick_m, 2.0 * kSwollenRadius_m, 2.0 * kSwollenRadius_m)});
  std::vector<Vec3> inside;
  for (const Vec3& p : skin.points)
    if (std::ranges::any_of(boxes, [&](const geometry::Box& box) {
          return (p.array() >= box.low.array()).all() && (p.array() <= box.high.array()).all();
        }))
      inside.push_back(p);
  Collider expected(proxy);
  const CoverReport wanted = expected.cover({}, inside, {.tolerance_m = kTolerance_m});
  REQUIRE(wanted.uncovered > 20);
  for (int repeat = 0; repeat < 2; ++repeat) {
    std::ranges::reverse(boxes);
    Collider collider(proxy);
    const CoverReport report =
        collider.cover({}, skin.points, {.tolerance_m = kTolerance_m, .within = std::span(boxes)});
    CHECK(report.uncovered == wanted.uncovered);
    CHECK(report.farthest_m == wanted.farthest_m);
    CHECK(report.left == wanted.left);
  }
}

TEST_CASE("a cover leaves every bit where the skin is inside, or is no skin of this surface" *
          doctest::test_suite("long")) {
  const auto proxy = scene();
  Collider collider(proxy);
  const Skin skin = swollen_skin(collider);
  Cloud cloud = around(8, 5000);
  const auto before = contacts_at(collider, cloud);
  const auto same = [&] {
    const auto after = contacts_at(collider, cloud);
    return std::memcmp(before.data(), after.data(), before.size() * sizeof(Contact)) == 0;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Vec3 far = proxy.ellipsoids()[0].shape.center + Vec3(3.0, 0.0, 0.0);
  const std::vector<Vec3> none, not_finite = {Vec3(nan, 0, 0), Vec3(0, kInf, 0)}, beside = {far};
  for (const auto* points : {&none, &not_finite, &beside}) {
    CHECK(collider.cover({}, *points, {.tolerance_m = kTolerance_m}).uncovered == 0);
    CHECK(same());
  }
  const geometry::Box elsewhere{far, far + Vec3::Ones()};
  CHECK(collider.cover({}, skin.points, {.within = std::span(&elsewhere, 1)}).uncovered == 0);
  CHECK(collider.cover({}, skin.points, {.tolerance_m = std::numeric_limits<float>::quiet_NaN()}).uncovered ==
        0);
  CHECK(collider.cover({}, skin.points, {.tolerance_m = -1.0f}).uncovered == 0);
  CHECK(same());
  const geometry::Box here{skin.swollen - Vec3::Constant(0.1), skin.swollen + Vec3::Constant(0.1)};
  CHECK(collider.cover({}, skin.points, {.within = std::span(&here, 1)}).uncovered > 50);
  CHECK_FALSE(same());

  Collider plain(proxy_of(random_ellipsoids(31, 40, 0.4, 0.06, 0.2)));
  CHECK(plain.cover({}, skin.points, {}).uncovered == 0);
}

TEST_CASE("ellipsoids without a table, or with one of two nodes a side, keep what they have under a cover" *
          doctest::test_suite("long")) {
  auto data = with_relief(data_of(random_ellipsoids(9, 40, 0.4, 0.05, 0.2)), 2, 0.003, 12);
  for (std::size_t k = 0; k < data.relief.size(); k += 3) data.relief[k] = {};
  Collider collider(proxy_of(data));
  const Skin skin = swollen_skin(collider);
  Cloud cloud = around(8, 5000);
  const auto before = contacts_at(collider, cloud);
  const CoverReport report = collider.cover({}, skin.points, {.tolerance_m = kTolerance_m});
  CHECK(report.left == report.uncovered);
  const auto after = contacts_at(collider, cloud);
  CHECK(std::memcmp(before.data(), after.data(), before.size() * sizeof(Contact)) == 0);
}

TEST_CASE("a table that rises stays continuous where the octahedral map is folded") {
  // The borders of the map are the directions (x, 0, z) and (0, y, z) with z < 0; its corners are (0, 0, -1).
  const auto flat = with_tables(data_of(ball(0.1)), 24, 0.002, [](std::size_t, int, int) {
    return proxy::ReliefTexel{128, 128};
  });
  for (const double angle : {0.0, 0.2, 0.7, 1.2})
    for (const bool along_x : {true, false}) {
      const auto beside = [&](double by, double radius_m) -> Vec3 {
        const double x = std::sin(angle), z = -std::cos(angle);
        return radius_m * (along_x ? Vec3(x, by, z) : Vec3(by, x, z)).normalized();
      };
      Collider collider(proxy_of(flat));
      const std::vector<Vec3> skin = {beside(0.02, 0.104)};  // on one side alone
      REQUIRE(collider.cover({}, skin, {.tolerance_m = kTolerance_m}).uncovered == 1);
      const double left = distance_at(collider, beside(-1e-5, 0.105));
      const double right = distance_at(collider, beside(1e-5, 0.105));
      CAPTURE(angle);
      CAPTURE(along_x);
      CHECK(right < 0.005 - 0.5e-3);  // it has risen
      CHECK(std::abs(left - right) < 1e-5);
    }
}

TEST_CASE("after a cover, queries with a limit have the bits of those without" *
          doctest::test_suite("long")) {
  Collider collider(scene());
  const Skin skin = swollen_skin(collider);
  REQUIRE(collider.cover({}, skin.points, {.tolerance_m = kTolerance_m}).uncovered > 50);
  // Particles close to the raised surface alone, so that a bound that was not raised would lose them.
  engine::Random random(4);
  Cloud cloud;
  for (const Vec3& p : skin.points)
    if ((p - skin.swollen).norm() < kSwollenRadius_m)
      for (int i = 0; i < 20; ++i) cloud.add(p - collider.origin() + random_vector(random, 0.002));
  REQUIRE(cloud.size() > 1000);
  const auto all = contacts_at(collider, cloud), inside = contacts_at(collider, cloud, 0.0f);
  std::size_t hit = 0, other = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (!(all[i].signed_distance <= 0.0f)) continue;
    ++hit;
    other += std::memcmp(&all[i], &inside[i], sizeof(Contact)) != 0;
  }
  CHECK(hit > 500);
  CHECK(other == 0);
}

TEST_CASE("a cover gives the same bits for any number of workers, and allocates nothing once warm" *
          doctest::test_suite("long")) {
  const auto proxy = scene();
  Collider first(proxy);
  const Skin skin = swollen_skin(first);
  first.cover({}, skin.points, {.tolerance_m = kTolerance_m});
  Cloud cloud = around(8, 5000);
  const auto expected = contacts_at(first, cloud);
  for (const auto& [name, executor] : all_executors()) {
    Collider collider(proxy);
    const engine::Context context{.executor = executor.get()};
    collider.cover(context, skin.points, {.tolerance_m = kTolerance_m});
    const auto found = contacts_at(collider, cloud);
    CAPTURE(name);
    CHECK(std::memcmp(expected.data(), found.data(), expected.size() * sizeof(Contact)) == 0);
  }
  if (!counts_allocations()) return;
  std::vector<Vec3> moved = skin.points;
  CHECK(allocations_when_warm(3, [&] {
          for (Vec3& p : moved) p += Vec3(1e-4, 0.0, 0.0);
          first.cover({}, moved, {.tolerance_m = kTolerance_m});
        }) == 0);
}
