// Velocities after the closest-point response.
#include <doctest/doctest.h>

#include <Eigen/Geometry>

#include "scenes.hpp"

using namespace bodice;
using namespace bodice::collision;
using namespace bodice_test;

namespace {

// A position on the tangent planes of a contact is a little off the curved surfaces.
constexpr double kSurelyOn_m = 2e-5, kSurelyOff_m = 2e-4;

/// Balls of half a meter that meet around the origin, which is up to a millimeter inside of each.
std::vector<Ellipsoid> corner(engine::Random& random, int count) {
  std::vector<Ellipsoid> shapes = std::vector<Ellipsoid>(static_cast<std::size_t>(count), ball(0.5)[0]);
  const Vec3 outward = random_direction(random);
  for (Ellipsoid& e : shapes)
    e.center = (random.uniform(1e-4, 1e-3) - 0.5) * (outward + 0.9 * random_direction(random)).normalized();
  return shapes;
}

/// The closest velocity that leads into none of the surfaces, by Dykstra's projections.
Vec3 closest_velocity(const std::vector<Vec3>& normals, Vec3 v) {
  std::vector<double> pushed(normals.size(), 0.0);
  for (int round = 0; round < 500; ++round)
    for (std::size_t i = 0; i < normals.size(); ++i) {
      const double along = normals[i].dot(v) - pushed[i];
      const double push = std::max(0.0, -along);
      v += (push - pushed[i]) * normals[i];
      pushed[i] = push;
    }
  return v;
}

/// Least difference of `after` from the velocity that some subset of the touched surfaces leaves of `before`.
/// A surface on which a push out of another puts the particle by chance is not a contact yet.
double velocity_error(const std::vector<Vec3>& touched, const Vec3& before, const Vec3& after) {
  double least = std::numeric_limits<double>::infinity();
  for (unsigned some = 1; some < 1u << touched.size(); ++some) {
    std::vector<Vec3> normals;
    for (std::size_t i = 0; i < touched.size(); ++i)
      if (some >> i & 1u) normals.push_back(touched[i]);
    least = std::min(least, (closest_velocity(normals, before) - after).norm());
  }
  return least;
}

}  // namespace

TEST_CASE("a contact removes the inward velocity, and friction slows the rest by at most its share") {
  const Collider collider(proxy_of(ball(1.0)));
  for (const float friction : {0.0f, 0.3f, 2.0f}) {
    Cloud cloud;
    cloud.add(Vec3(0, 0.999, 0), Vec3(1.0, -2.0, 0.0));
    cloud.add(Vec3(0, 0.999, 0), Vec3(1.0, 2.0, 0.0));
    collider.resolve({}, cloud.particles(), {.friction = friction});
    const double along = std::max(0.0, 1.0 - 2.0 * double{friction});
    CHECK(cloud.velocity(0).x() == doctest::Approx(along).epsilon(1e-5).scale(1.0));
    CHECK(cloud.velocity(0).y() == doctest::Approx(0.0).epsilon(1e-5).scale(1.0));
    // This particle moves outward already, so that nothing is removed.
    CHECK(cloud.velocity(1).y() == doctest::Approx(2.0).epsilon(1e-5));
    CHECK(cloud.velocity(1).x() == doctest::Approx(1.0).epsilon(1e-5));
  }
}

TEST_CASE("in a crease the velocity leads into neither side and stays along the crease") {
  auto shapes = ball(0.5);
  shapes.push_back(shapes[0]);
  shapes[0].center.x() = -0.4;
  shapes[1].center.x() = 0.4;
  const Collider collider(proxy_of(shapes));
  Cloud cloud;
  cloud.add(Vec3(0.001, 0.28, 0.0), Vec3(0.1, -1.0, 0.5));
  const ContactReport report = collider.resolve({}, cloud.particles(), {.friction = 0.0f});
  CHECK(report.judged_exactly == 0);  // resolved by the kernels
  for (const Ellipsoid& e : shapes) {
    const Vec3 outward = (cloud.position(0) + collider.origin() - e.center).normalized();
    CHECK(outward.dot(cloud.velocity(0)) > -1e-4);
  }
  CHECK(cloud.velocity(0).head<2>().norm() < 1e-3);
  CHECK(cloud.velocity(0).z() == doctest::Approx(0.5).epsilon(1e-3));
}

TEST_CASE("velocities lead into no surface that a particle ends on and ignore all others") {
  for (const bool exactly : {false, true}) {
    CAPTURE(exactly);
    engine::Random random(23);
    int judged = 0, left_behind = 0, wrong = 0;
    for (int i = 0; i < 3000; ++i) {
      const auto shapes = corner(random, 3 + i % 3);
      const Collider collider(proxy_of(shapes));
      const Vec3 velocity = random_vector(random, 1.0);
      Cloud cloud;
      cloud.add(-collider.origin(), velocity);
      // A path this long goes to the exact side, which ignores it because it begins inside a ball.
      if (exactly) cloud.add_safe(shapes[0].center - collider.origin());
      const ContactReport report = collider.resolve({}, cloud.particles(), {.friction = 0.0f});
      if ((report.judged_exactly == 1) != exactly) continue;
      std::vector<Vec3> touched;
      bool unclear = false;
      for (const Ellipsoid& e : shapes) {
        const auto at = geometry::closest_point(e, cloud.position(0) + collider.origin());
        if (at.signed_distance < kSurelyOn_m) touched.push_back(at.normal);
        unclear |= at.signed_distance >= kSurelyOn_m && at.signed_distance < kSurelyOff_m;
      }
      if (unclear || touched.empty()) continue;
      ++judged;
      left_behind += touched.size() < shapes.size();
      wrong += velocity_error(touched, velocity, cloud.velocity(0)) > 0.05;
    }
    CHECK(judged > 1000);
    CHECK(left_behind > 500);
    CHECK(wrong == 0);
  }
}

TEST_CASE("a surface that the last push left removes no velocity") {
  // Balls this large are almost planes. The push out of the first leads into the second, that out of both
  // into the third, and where first and third meet, the second is 0.7 mm away.
  const Vec3 normal[] = {Vec3(0.754781, -0.65547, -0.0257928), Vec3(0.906131, 0.119704, 0.405707),
                         Vec3(0.998862, 0.00784065, 0.0470552)};
  const double depth_m[] = {0.0480944, 0.0393062, 0.0463850};
  std::vector<Ellipsoid> shapes(3, ball(50.0)[0]);
  for (std::size_t k = 0; k < 3; ++k) shapes[k].center = (depth_m[k] - 50.0) * normal[k].normalized();
  Vec3 along = normal[0].cross(normal[2]).normalized();
  if (along.dot(normal[1]) > 0.0) along = -along;
  const Collider collider(proxy_of(shapes));
  for (const bool exactly : {false, true}) {
    Cloud cloud;
    cloud.add(-collider.origin(), along);
    if (exactly)
      cloud.add_safe(shapes[0].center - collider.origin());  // long, and ignored because it begins inside
    const ContactReport report = collider.resolve({}, cloud.particles(), {.friction = 0.0f});
    CAPTURE(exactly);
    CHECK(report.judged_exactly == (exactly ? 1u : 0u));
    CHECK(report.max_iterations >= 3);
    const Vec3 at = cloud.position(0) + collider.origin();
    CHECK(geometry::closest_point(shapes[1], at).signed_distance > 5e-4);
    CHECK((cloud.velocity(0) - along).norm() < 0.01);
  }
}

TEST_CASE("a moving body drags a particle in contact with its own velocity") {
  auto shapes = ball(1.0);
  Collider collider(proxy_of(shapes));
  shapes[0].center.x() = 0.03;
  collider.move_to(shapes, 0.01);
  const Vec3 velocity = collider.surface_velocity(0, Vec3(0.0, 1.0, 0.0));
  CHECK((velocity - Vec3(3.0, 0.0, 0.0)).norm() < 1e-5);
  Cloud cloud;
  cloud.add(Vec3(0.03, 0.999, 0.0), Vec3(0.0, -10.0, 0.0));
  collider.resolve({}, cloud.particles(), {.friction = 5.0f});
  CHECK((cloud.velocity(0) - Vec3(3.0, 0.0, 0.0)).norm() < 1e-3);
}

TEST_CASE("in each of several moves the surface has its material's velocity") {
  constexpr double kStep_s = 0.02;
  const Mat3 turn = Eigen::AngleAxisd(0.8, Vec3(1.0, 2.0, -1.0).normalized()).toRotationMatrix();
  Ellipsoid now{.radii = Vec3(0.5, 0.2, 0.1)};
  Collider collider(proxy_of({now}));
  const auto point_of = [](const Ellipsoid& e, const Vec3& u) {
    return Vec3(e.center + e.axes * e.radii.cwiseProduct(u));
  };
  for (int move = 0; move < 4; ++move) {
    const Ellipsoid before = now;
    now = {.center = turn * before.center + Vec3(0.02, -0.01, 0.03),
           .axes = turn * before.axes,
           .radii = 1.05 * before.radii};
    REQUIRE(collider.move_to(std::vector{now}, kStep_s));
    for (int i = 0; i < 3; ++i)
      for (const double side : {-1.0, 1.0}) {
        const Vec3 u = side * Vec3::Unit(i), at = point_of(now, u);
        const Vec3 truth = (at - point_of(before, u)) / kStep_s;
        const Vec3 found = collider.surface_velocity(0, at - collider.origin());
        CHECK((found - truth).norm() < 1e-4 * truth.norm());
      }
  }
}
