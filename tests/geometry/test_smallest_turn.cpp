#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

#include <bodice/engine/random.hpp>
#include <bodice/geometry/smallest_turn.hpp>

using namespace bodice;
using geometry::Vec3;

namespace {

Vec3 any_vector(engine::Random& random) {
  return {random.normal(), random.normal(), random.normal()};
}

double angle_between(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

TEST_CASE("the smallest turn takes one direction to the other by the angle between them") {
  engine::Random random(5);
  for (int i = 0; i < 500; ++i) {
    const Vec3 from = std::pow(10.0, random.uniform(-9.0, 9.0)) * any_vector(random);
    // Some are nearly parallel, and some nearly opposite.
    const double aside = std::pow(10.0, random.uniform(-8.0, 1.0));
    const Vec3 to = (i % 2 ? 1.0 : -1.0) * from.normalized() + aside * any_vector(random);
    const Eigen::Quaterniond turn = geometry::smallest_turn(from, to);
    CHECK(turn.norm() == doctest::Approx(1.0).epsilon(1e-7));
    CHECK((turn * from.normalized() - to.normalized()).norm() < 1e-7);
    const double angle = 2.0 * std::atan2(turn.vec().norm(), turn.w());
    CHECK(angle == doctest::Approx(angle_between(from, to)).epsilon(1e-6));
  }
}

TEST_CASE("the smallest turn between opposite directions is half a turn about an axis across them") {
  for (const Vec3& from :
       {Vec3(1.0, 0.0, 0.0), Vec3(0.0, -2.0, 0.0), Vec3(0.3, -0.4, 5.0), Vec3(1e-9, 1e-9, 0.0)}) {
    const Eigen::Quaterniond turn = geometry::smallest_turn(from, -3.0 * from);
    CHECK(turn.norm() == doctest::Approx(1.0));
    CHECK(std::abs(turn.w()) < 1e-12);
    CHECK((turn * from.normalized() + from.normalized()).norm() < 1e-12);
  }
  CHECK(geometry::smallest_turn(Vec3(0.0, 1.0, 0.0), Vec3(0.0, 2.0, 0.0)).w() == 1.0);
}
