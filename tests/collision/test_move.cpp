// Poses that a host passes as ellipsoids: axes out of chains of floats, scales, and what is refused.
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <Eigen/SVD>

#include <bodice/collision/collider.hpp>
#include <bodice/collision/pose_refusal.hpp>
#include <bodice/engine/random.hpp>

#include "scenes.hpp"

using namespace bodice;
using namespace bodice_test;
using collision::Collider;

namespace {

/// Distances at some points around the ellipsoids.
std::vector<float> distances(const Collider& collider) {
  const engine::Random random(17);
  std::vector<float> found;
  for (std::uint64_t i = 0; i < 200; ++i) {
    const auto coordinate = [&](std::uint64_t axis) {
      return static_cast<float>(2.0 * random.uniform_at(3 * i + axis) - 1.0);
    };
    found.push_back(collider.query({coordinate(0), coordinate(1), coordinate(2)}).signed_distance);
  }
  return found;
}

/// The product of so many float matrices, each a rotation by a unit quaternion of floats.
Eigen::Matrix3f chain_of(int links, const engine::Random& random, std::uint64_t& draw) {
  Eigen::Matrix3f chain = Eigen::Matrix3f::Identity();
  for (int link = 0; link < links; ++link) {
    Eigen::Vector4f q;
    for (int i = 0; i < 4; ++i) q[i] = static_cast<float>(2.0 * random.uniform_at(draw++) - 1.0);
    chain = chain * Eigen::Quaternionf(q.normalized()).toRotationMatrix();
  }
  return chain;
}

}  // namespace

TEST_CASE("axes out of chains of twenty float matrices are taken in every frame, as right as their floats" *
          doctest::test_suite("long")) {
  const auto shapes = random_ellipsoids(5, 30, 0.8, 0.02, 0.2);
  Collider collider(proxy_of(shapes)), exact(proxy_of(shapes));
  const engine::Random random(9);
  std::uint64_t draw = 0;
  for (int frame = 0; frame < 100; ++frame) {
    auto drifted = shapes, mended = shapes;
    for (std::size_t k = 0; k < shapes.size(); ++k) {
      drifted[k].axes = chain_of(20, random, draw).cast<double>();
      Eigen::JacobiSVD<Eigen::Matrix3d> svd(drifted[k].axes, Eigen::ComputeFullU | Eigen::ComputeFullV);
      mended[k].axes = svd.matrixU() * svd.matrixV().transpose();
    }
    REQUIRE(collider.move_to(drifted, 0.0));
    REQUIRE(exact.move_to(mended, 0.0));
    const std::vector<float> found = distances(collider), truth = distances(exact);
    float worst_m = 0.0f;
    for (std::size_t i = 0; i < found.size(); ++i) worst_m = std::max(worst_m, std::abs(found[i] - truth[i]));
    CHECK(worst_m < 2e-6f);
  }
}

TEST_CASE("axes that are off by a thousandth are mended, and a uniform scale goes to the radii") {
  const auto shapes = random_ellipsoids(6, 12, 0.8, 0.02, 0.2);
  Collider collider(proxy_of(shapes)), truth(proxy_of(shapes));
  auto drifted = shapes, larger = shapes, scaled = shapes;
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    drifted[k].axes(0, 1) += 1e-3;
    scaled[k].axes *= 1.05;
    larger[k].radii *= 1.05;
  }
  REQUIRE(collider.move_to(drifted, 0.0));
  REQUIRE(truth.move_to(shapes, 0.0));
  std::vector<float> found = distances(collider), expected = distances(truth);
  // The mended axes are turned by at most a thousandth, and radii are 0.2 at most.
  for (std::size_t i = 0; i < found.size(); ++i) CHECK(std::abs(found[i] - expected[i]) < 2e-4f);
  REQUIRE(collider.move_to(scaled, 0.0));
  REQUIRE(truth.move_to(larger, 0.0));
  found = distances(collider), expected = distances(truth);
  for (std::size_t i = 0; i < found.size(); ++i) CHECK(std::abs(found[i] - expected[i]) < 2e-6f);
}

TEST_CASE("a refused pose names the ellipsoid, its part and the reason, and nothing moves") {
  const auto shapes = random_ellipsoids(5, 5, 0.8, 0.02, 0.2);
  Collider collider(proxy_of(shapes));
  const std::vector<float> before = distances(collider);
  struct Case {
    const char* reason;
    void (*spoil)(Ellipsoid&);
  };
  const std::string name = "ellipsoid 3 (" + std::string(body::name(static_cast<body::Part>(3))) + ")";
  const Case cases[] = {
      {"is not finite", [](Ellipsoid& e) { e.center.y() = std::numeric_limits<double>::quiet_NaN(); }},
      {"has a radius that is not above zero", [](Ellipsoid& e) { e.radii.z() = 0.0; }},
      {"mirrors", [](Ellipsoid& e) { e.axes.col(1) *= -1.0; }},
      {"shears", [](Ellipsoid& e) { e.axes(0, 1) += 0.1; }},
      {"is flat", [](Ellipsoid& e) { e.axes.col(0) *= 1e-30; }},
      {"has no extent", [](Ellipsoid& e) { e.axes.setZero(); }},
      {"larger than a million", [](Ellipsoid& e) { e.axes *= 1e7; }}};
  for (const Case& c : cases) {
    CAPTURE(c.reason);
    auto moved = shapes;
    for (Ellipsoid& e : moved) e.center.x() += 0.5;
    c.spoil(moved[3]);
    CHECK_FALSE(collider.move_to(moved, 0.01));
    const auto why = collision::why_refused(proxy_of(shapes), moved);
    REQUIRE(why);
    CHECK(why->code == engine::ErrorCode::kInvalidArgument);
    CHECK(why->message.find(name) != std::string::npos);
    CHECK(why->message.find(c.reason) != std::string::npos);
    CHECK(distances(collider) == before);
  }
  CHECK_FALSE(collision::why_refused(proxy_of(shapes), shapes));
  const auto few = std::span(shapes).first(4);
  CHECK_FALSE(collider.move_to(few, 0.01));
  const auto why = collision::why_refused(proxy_of(shapes), few);
  REQUIRE(why);
  CHECK(why->message == "Collider: the pose has 4 ellipsoids, and the proxy 5.");
  CHECK(distances(collider) == before);
}

TEST_CASE("a step in which no body can move leaves velocities at zero, not infinite") {
  const auto shapes = random_ellipsoids(7, 6, 0.8, 0.05, 0.2);
  Collider collider(proxy_of(shapes));
  auto moved = shapes;
  double shift_m = 0.0;
  for (const double dt_s : {1e-300, 5e-324, 1e-30, 1e30, std::numeric_limits<double>::infinity()}) {
    CAPTURE(dt_s);
    shift_m += 0.01;
    for (std::size_t k = 0; k < moved.size(); ++k)
      moved[k].center = shapes[k].center + geometry::Vec3(shift_m, 0.0, 0.0);
    REQUIRE(collider.move_to(moved, dt_s));
    const geometry::Vec3 at = moved.front().center - collider.origin();
    CHECK(collider.surface_velocity(0, at) == geometry::Vec3::Zero());
    float x = static_cast<float>(at.x()), y = static_cast<float>(at.y()), z = static_cast<float>(at.z());
    float vx = 0.0f, vy = 0.0f, vz = 0.0f;
    const auto report =
        collider.resolve({}, {.count = 1, .x = &x, .y = &y, .z = &z, .vx = &vx, .vy = &vy, .vz = &vz}, {});
    CHECK(report.not_finite == 0);
    CHECK(std::isfinite(x + y + z + vx + vy + vz));
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
