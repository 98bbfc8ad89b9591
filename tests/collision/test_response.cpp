#include <doctest/doctest.h>

#include "scenes.hpp"

using namespace bodice;
using namespace bodice::collision;
using namespace bodice_test;

namespace {

Cloud around_origin(std::uint64_t seed, int count, double half_side) {
  engine::Random random(seed);
  Cloud cloud;
  for (int i = 0; i < count; ++i) cloud.add(random_vector(random, half_side), random_vector(random, 1.0));
  return cloud;
}

/// Particles of which half are in a cube, the others in and just around the ellipsoids.
Cloud among(const std::vector<Ellipsoid>& shapes, const Vec3& origin, int count, double half_side) {
  Cloud cloud = around_origin(11, count / 2, half_side);
  engine::Random random(12);
  for (int i = 0; i < count / 2; ++i) {
    const Ellipsoid& e = shapes[random.below(shapes.size())];
    const Vec3 unit = random_vector(random, 1.0);
    cloud.add(e.center + e.axes * e.radii.cwiseProduct(unit) - origin, random_vector(random, 1.0));
  }
  return cloud;
}

/// The lowest union distance of the cloud, by brute force in double precision.
double lowest_m(const std::vector<Ellipsoid>& shapes, const Collider& collider, const Cloud& cloud) {
  double lowest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < cloud.size(); ++i)
    lowest = std::min(lowest, brute_force(shapes, cloud.position(i) + collider.origin()).signed_distance);
  return lowest;
}

/// Number of particles nearer to the union than `distance_m`.
std::size_t below(const std::vector<Ellipsoid>& shapes, const Collider& collider, const Cloud& cloud,
                  double distance_m) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i)
    count += brute_force(shapes, cloud.position(i) + collider.origin()).signed_distance < distance_m;
  return count;
}

}  // namespace

TEST_CASE("a closest-point response leaves no particle inside any union" * doctest::test_suite("long")) {
  struct Scene {
    int ellipsoids;
    double least_m, largest_m;
  };
  for (const Scene scene :
       {Scene{1, 0.05, 0.3}, {2, 0.1, 0.3}, {12, 0.05, 0.3}, {80, 0.02, 0.4}, {8, 0.001, 1.0}})
    for (const float thickness_m : {0.0f, 0.004f}) {
      const auto shapes = random_ellipsoids(7, scene.ellipsoids, 0.4, scene.least_m, scene.largest_m);
      const Collider collider(proxy_of(shapes));
      Cloud cloud = among(shapes, collider.origin(), 20000, 0.8);
      const ContactReport report = collider.resolve({}, cloud.particles(), {.thickness_m = thickness_m});
      CAPTURE(scene.ellipsoids);
      CAPTURE(thickness_m);
      CHECK(report.contacts > 4000);
      CHECK(report.unresolved == 0);
      CHECK(lowest_m(shapes, collider, cloud) > -1e-6);
      CHECK(below(shapes, collider, cloud, double{thickness_m} - 1e-6) == report.pinched);
      CHECK(report.pinched < report.contacts / 100);
      // Clear particles stay: a second call finds only those that are pinched, and moves no other.
      const Cloud settled = cloud;
      const ContactReport again = collider.resolve({}, cloud.particles(), {.thickness_m = thickness_m});
      CHECK(again.contacts == report.pinched);
      std::size_t moved = 0;
      for (std::size_t i = 0; i < cloud.size(); ++i) moved += cloud.x[i] != settled.x[i];
      CHECK(moved <= report.pinched);
    }
}

TEST_CASE(
    "a response resolves needles, discs, identical, nested and tangent ellipsoids, and particles at "
    "centers") {
  std::vector<std::vector<Ellipsoid>> scenes;
  scenes.push_back(random_ellipsoids(5, 6, 0.2, 0.001, 1.0));
  scenes.push_back(std::vector<Ellipsoid>(50, random_ellipsoids(5, 1, 0.1, 0.1, 0.3)[0]));
  auto nested = std::vector<Ellipsoid>(6, scenes.back()[0]);
  for (std::size_t k = 0; k < nested.size(); ++k) nested[k].radii *= 1.0 - 0.1 * static_cast<double>(k);
  scenes.push_back(nested);
  auto tangent = ball(0.25);
  tangent.push_back(tangent[0]);
  tangent[0].center.x() = 0.25;
  tangent[1].center.x() = -0.25;
  scenes.push_back(tangent);
  for (const auto& shapes : scenes) {
    const Collider collider(proxy_of(shapes));
    Cloud cloud = around_origin(3, 5000, 0.5);
    for (const Ellipsoid& e : shapes) cloud.add(e.center - collider.origin());
    for (int i = 0; i < 2000; ++i)
      cloud.z[static_cast<std::size_t>(i)] = static_cast<float>(shapes[0].center.z() - collider.origin().z());
    const ContactReport report = collider.resolve({}, cloud.particles(), {});
    CHECK(report.contacts > 0);
    CHECK(report.unresolved == 0);
    CHECK(lowest_m(shapes, collider, cloud) > -1e-6);
  }
}

TEST_CASE("a particle inside a single ellipsoid moves to its closest point") {
  const auto shapes = random_ellipsoids(21, 1, 0.1, 0.1, 0.4);
  const Collider collider(proxy_of(shapes));
  Cloud cloud = around_origin(2, 5000, 0.3);
  const Cloud before = cloud;
  collider.resolve({}, cloud.particles(), {});
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const auto at = geometry::closest_point(shapes[0], before.position(i) + collider.origin());
    if (at.signed_distance >= 0.0) continue;
    CHECK((cloud.position(i) + collider.origin() - at.point).norm() < 2e-6);
  }
}

TEST_CASE("a particle near a crease moves to the crease, which no single push reaches") {
  auto shapes = ball(0.5);
  shapes.push_back(shapes[0]);
  shapes[0].center.x() = -0.4;
  shapes[1].center.x() = 0.4;
  const Collider collider(proxy_of(shapes));
  Cloud cloud;
  cloud.add(Vec3(0.001, 0.28, 0.0));
  const ContactReport report = collider.resolve({}, cloud.particles(), {});
  CHECK(report.contacts == 1);
  CHECK(report.fallbacks == 0);
  // The spheres cross in the circle x = 0, y^2 + z^2 = 0.5^2 - 0.4^2.
  CHECK(cloud.position(0).x() == doctest::Approx(0.0).epsilon(1e-3).scale(1.0));
  CHECK(cloud.position(0).y() == doctest::Approx(0.3).epsilon(1e-3));
}

TEST_CASE("a push is limited beyond undoing a path that leads inward, by kernels and by the exact side") {
  struct Path {
    double from_y, pushed_to_y;
  };
  // The first path leads inward by 5 mm, which the push may undo; the second leads outward. A body that moves
  // in the same time takes the start of the path with it.
  for (const auto& [from_y, pushed_to_y] : {Path{0.485, 0.486}, Path{0.475, 0.481}})
    for (const bool exactly : {false, true})
      for (const double moved_by_y : {0.0, -0.1, 0.1}) {
        auto shapes = ball(0.5);
        // Next to so small an ellipsoid a path of 5 mm is long enough for the exact side.
        shapes.push_back(ball(0.005)[0]);
        shapes[1].center = exactly ? Vec3(0.0045, 0.4825, 0.0045) : Vec3(0.0, -0.47, 0.0);
        Collider collider(proxy_of(shapes));
        for (Ellipsoid& e : shapes) e.center.y() += moved_by_y;
        if (moved_by_y != 0.0) collider.move_to(shapes, 0.01);
        Cloud cloud;
        cloud.add(Vec3(0.0, 0.48 + moved_by_y, 0.0));
        cloud.add_safe(Vec3(0.0, from_y, 0.0));
        const ContactReport report = collider.resolve({}, cloud.particles(), {.max_push_m = 0.001f});
        CAPTURE(exactly);
        CAPTURE(from_y);
        CAPTURE(moved_by_y);
        CHECK(report.judged_exactly == (exactly ? 1u : 0u));
        CHECK(report.pending == 1);
        CHECK(double{cloud.y[0]} - moved_by_y == doctest::Approx(pushed_to_y).epsilon(1e-5));
      }
}

TEST_CASE("options that are NaN, infinite or negative do no harm") {
  const float nan = std::numeric_limits<float>::quiet_NaN(),
              infinity = std::numeric_limits<float>::infinity();
  const auto shapes = ball(1.0);
  const Collider collider(proxy_of(shapes));
  const auto moved = [&](const ResolveOptions& options) {
    Cloud cloud;
    cloud.add(Vec3(0.0, 0.9, 0.0), Vec3(1.0, -1.0, 0.0));
    const ContactReport report = collider.resolve({}, cloud.particles(), options);
    CHECK(report.contacts == 1);
    CHECK(cloud.position(0).norm() == doctest::Approx(1.0).epsilon(1e-5));
    return cloud.velocity(0);
  };
  const Vec3 slippery = moved({.friction = 0.0f});
  CHECK(slippery.x() == doctest::Approx(1.0));
  for (const float friction : {nan, -3.0f, -infinity}) CHECK(moved({.friction = friction}) == slippery);
  CHECK(moved({.friction = infinity}).norm() < 1e-6);
  const Vec3 usual = moved({});
  for (const float length_m : {nan, infinity, -infinity}) {
    CHECK(moved({.thickness_m = length_m}) == usual);
    CHECK(moved({.blend_m = length_m}) == usual);
  }
  CHECK(moved({.max_push_m = nan}) == usual);
  CHECK(moved({.blend_m = -1.0f}) == usual);
}

TEST_CASE("the paper's case 3: a particle leaves a limb on the side where it entered") {
  const auto shapes = limb();
  const Collider collider(proxy_of(shapes));
  engine::Random random(6);
  Cloud cloud;
  for (int i = 0; i < 500; ++i) {
    const double x = random.uniform(-0.25, 0.25);
    // The particles fell from above to below the middle, so that the shortest exit is downward.
    cloud.add(Vec3(x, random.uniform(-0.03, -0.005), 0.0), Vec3(0, -20, 0));
    cloud.add_safe(Vec3(x, 0.07, 0.0));
  }
  const ContactReport report = collider.resolve({}, cloud.particles(), {});
  CHECK(report.wrong_side == 500);
  CHECK(lowest_m(shapes, collider, cloud) > -1e-6);
  for (std::size_t i = 0; i < cloud.size(); ++i) CHECK(cloud.y[i] > 0.03f);
}

TEST_CASE("the rest of a path through a limb continues along its surface") {
  const auto shapes = limb();
  const Collider collider(proxy_of(shapes));
  Cloud cloud;
  // The path reaches the limb at about x = 0.01; a third of the shortest radius nearby is 0.0135.
  cloud.add(Vec3(0.05, -0.03, 0.0));
  cloud.add_safe(Vec3(0.0, 0.07, 0.0));
  const ContactReport report = collider.resolve({}, cloud.particles(), {});
  CHECK(report.wrong_side == 1);
  CHECK(cloud.x[0] > 0.02f);
  CHECK(cloud.y[0] > 0.03f);
  CHECK(lowest_m(shapes, collider, cloud) > -1e-6);
}

TEST_CASE("the rest of a path into a corner continues along both of its surfaces") {
  std::vector<Ellipsoid> shapes(2);  // a floor up to y = 0, and a wall up to x = 0
  shapes[0].radii = Vec3(0.5, 0.05, 0.5);
  shapes[0].center.y() = -0.05;
  shapes[1].radii = Vec3(0.05, 0.5, 0.5);
  shapes[1].center.x() = 0.05;
  const Collider collider(proxy_of(shapes));
  Cloud cloud;
  cloud.add(Vec3(0.03, -0.08, 0.04) - collider.origin());
  cloud.add_safe(Vec3(-0.02, 0.04, 0.0) - collider.origin());
  const ContactReport report = collider.resolve({}, cloud.particles(), {});
  const Vec3 at = cloud.position(0) + collider.origin();
  CHECK(report.wrong_side == 1);
  CHECK(at.z() > 0.02);  // the path reaches the floor at z = 0.013, 3 mm from the wall
  for (const Ellipsoid& e : shapes) CHECK(geometry::closest_point(e, at).signed_distance < 1e-3);
  CHECK(lowest_m(shapes, collider, cloud) > -1e-6);
}

TEST_CASE("no particle tunnels through a limb at speeds up to 1,000 m/s") {
  const auto shapes = limb();
  const Collider collider(proxy_of(shapes));
  engine::Random random(8);
  for (const double speed_m_s : {10.0, 100.0, 1000.0}) {
    Cloud cloud;
    const double path_m = speed_m_s / 60.0;
    for (int i = 0; i < 2000; ++i) {
      const Vec3 from(random.uniform(-0.3, 0.3), 0.06 + random.uniform(0.0, 0.05),
                      random.uniform(-0.02, 0.02));
      cloud.add(from - Vec3(0, path_m, 0), Vec3(0, -speed_m_s, 0));
      cloud.add_safe(from);
    }
    const ContactReport report = collider.resolve({}, cloud.particles(), {});
    CHECK(report.unresolved == 0);
    int through = 0;
    for (std::size_t i = 0; i < cloud.size(); ++i) through += cloud.y[i] < 0.0f;
    CAPTURE(speed_m_s);
    CHECK(through == 0);
  }
}

TEST_CASE("a particle that slides along a limb does not count as on the wrong side") {
  const auto shapes = limb();
  const Collider collider(proxy_of(shapes));
  Cloud cloud;
  for (int i = 0; i < 64; ++i) {
    const double angle = 0.1 * i;
    cloud.add(Vec3(0.01, 0.0495 * std::cos(angle + 0.2), 0.0445 * std::sin(angle + 0.2)));
    cloud.add_safe(Vec3(0.0, 0.0501 * std::cos(angle), 0.0451 * std::sin(angle)));
  }
  CHECK(collider.resolve({}, cloud.particles(), {}).wrong_side == 0);
}

TEST_CASE("particles deep inside come out over several calls, and no push exceeds the limit") {
  const auto shapes = ball(0.5);
  const Collider collider(proxy_of(shapes));
  Cloud cloud = around_origin(4, 500, 0.25);
  int calls = 0;
  for (std::uint64_t pending = 1; pending > 0 && calls < 100; ++calls) {
    const Cloud before = cloud;
    const ContactReport report = collider.resolve({}, cloud.particles(), {.max_push_m = 0.02f});
    pending = report.pending;
    CHECK(report.unresolved == 0);
    for (std::size_t i = 0; i < cloud.size(); ++i)
      CHECK((cloud.position(i) - before.position(i)).norm() < 0.0201);
  }
  CHECK(calls >= 20);
  CHECK(calls <= 27);
  CHECK(lowest_m(shapes, collider, cloud) > -1e-6);
}

TEST_CASE("with relief a response leaves no particle below the corrected surface") {
  const auto shapes = random_ellipsoids(12, 40, 0.4, 0.06, 0.25);
  const auto proxy = proxy_of(with_relief(data_of(shapes), 16, 0.003, 5));
  const Collider collider(proxy);
  Cloud cloud = around_origin(3, 20000, 0.7);
  const ContactReport report = collider.resolve({}, cloud.particles(), {.thickness_m = 0.001f});
  CHECK(report.contacts > 1000);
  CHECK(report.unresolved == 0);
  std::vector<Contact> contacts(cloud.size());
  collider.query({}, cloud.particles(), contacts);
  float lowest = 1.0f;
  std::size_t short_of = 0;
  for (const Contact& c : contacts) {
    lowest = std::min(lowest, c.signed_distance);
    short_of += c.signed_distance < 0.001f - 1e-5f;
  }
  CHECK(lowest > -5e-5f);
  CHECK(short_of <= report.pinched);
  CHECK(report.pinched < report.contacts / 20);
}

TEST_CASE("with relief a push from body to body finds ellipsoids that were not near before") {
  // The push out of the first ball leads 40 mm deep into the second, and the push out of that into the third.
  // The third is near neither the start nor the end of the first push.
  std::vector<Ellipsoid> shapes = ball(0.1);
  shapes.resize(3, shapes[0]);
  shapes[0].center = Vec3(-0.06, 0.0, 0.0);
  shapes[1].center = Vec3(0.05, -0.06, 0.0);
  shapes[2] = ball(0.02)[0];
  shapes[2].center = Vec3(0.0335, 0.0307, 0.0);
  const auto proxy = proxy_of(with_relief(data_of(shapes), 8, 1e-6, 5));
  const Collider collider(proxy);
  Cloud cloud;
  engine::Random random(6);
  for (int i = 0; i < 40; ++i) cloud.add(random_vector(random, 1e-4) - collider.origin());
  const ContactReport report = collider.resolve({}, cloud.particles(), {});
  CHECK(report.contacts == 40);
  CHECK(report.max_iterations >= 3);
  CHECK(report.judged_exactly == 0);
  CHECK(lowest_m(shapes, collider, cloud) > -1e-5);
}

TEST_CASE("the paper's response leaves particles inside where ellipsoids meet, and counts them") {
  const auto shapes = random_ellipsoids(7, 40, 0.4, 0.05, 0.3);
  const Collider collider(proxy_of(shapes));
  Cloud cloud = around_origin(11, 10000, 0.6);
  const ContactReport report = collider.resolve({}, cloud.particles(), {.response = Response::kPaper});
  std::uint64_t inside = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i)
    inside += brute_force(shapes, cloud.position(i) + collider.origin()).signed_distance < -1e-6 * 0.8;
  CHECK(inside > 0);
  CHECK(std::abs(static_cast<double>(report.unresolved) - static_cast<double>(inside)) <= 2.0);
}

TEST_CASE(
    "the paper's response to one ellipsoid moves along the central ray and scales the speed by lengths") {
  const Collider collider(proxy_of(ball(1.0)));
  Cloud cloud;
  cloud.add(Vec3(0.5, 0.0, 0.0), Vec3(0.0, 3.0, 0.0));
  const ContactReport report = collider.resolve({}, cloud.particles(), {.response = Response::kPaper});
  CHECK(report.contacts == 1);
  CHECK(cloud.x[0] == doctest::Approx(1.0));
  // |c P0| / (|c P0| + |P0 p0|) = 1 / (1 + 0.5)
  CHECK(cloud.vy[0] == doctest::Approx(2.0));
}

TEST_CASE("the margin is part of the surface") {
  auto data = data_of(ball(0.5));
  data.margin_m = 0.01;
  const Collider collider(proxy_of(data));
  CHECK(collider.query({0.0f, 0.6f, 0.0f}).signed_distance == doctest::Approx(0.09));
  CHECK(collider.query({0.0f, 0.6f, 0.0f}).point[1] == doctest::Approx(0.51));
  Cloud cloud;
  cloud.add(Vec3(0.0, 0.505, 0.0));
  collider.resolve({}, cloud.particles(), {.thickness_m = 0.002f});
  CHECK(cloud.y[0] == doctest::Approx(0.512));
}
