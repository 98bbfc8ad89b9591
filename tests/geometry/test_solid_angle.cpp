// White-box: one turn too few or too many is a whole winding number, and only few sums come near such a
// border.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <bodice/engine/random.hpp>

#include "shape/solid_angle.hpp"

using namespace bodice::geometry;
using bodice::engine::Random;

namespace {

/// Twice the sum of the half angles, with one arc tangent each.
long double one_by_one(const std::vector<HalfAngle>& halves) {
  long double sum = 0;
  for (const auto& [sine, cosine] : halves)
    if (sine != 0.0) sum += 2 * std::atan2(static_cast<long double>(sine), static_cast<long double>(cosine));
  return sum;
}

double together(const std::vector<HalfAngle>& halves) {
  SolidAngleSum sum;
  for (const HalfAngle& h : halves) sum.add(h);
  return sum.total();
}

HalfAngle at(double angle, double factor) {
  return {factor * std::sin(angle), factor * std::cos(angle)};
}

}  // namespace

TEST_CASE("a sum of solid angles keeps its turns, whatever the signs, the sizes and the factors") {
  Random random(43);
  for (int i = 0; i < 20000; ++i) {
    std::vector<HalfAngle> halves;
    const int count = 1 + static_cast<int>(random.uniform(0.0, 60.0));
    const double most = i % 2 ? std::numbers::pi : 0.3, lean = random.uniform(-1.0, 1.0);
    for (int k = 0; k < count; ++k) {
      const double angle = most * std::clamp(lean + random.uniform(-1.0, 1.0), -1.0, 1.0);
      halves.push_back(at(angle, std::pow(10.0, random.uniform(-40.0, 2.0))));
    }
    REQUIRE(together(halves) == doctest::Approx(static_cast<double>(one_by_one(halves))).epsilon(1e-11));
  }
}

TEST_CASE("sums that end on a turn's border are off by rounding, never by a turn") {
  constexpr double kPi = std::numbers::pi;
  const double eighths[] = {kPi / 8, kPi / 4, kPi / 2, 3 * kPi / 4, 7 * kPi / 8, kPi * (1 - 1e-15)};
  for (const double a : eighths)
    for (const double b : eighths)
      for (const double c : eighths)
        for (const int signs : {0, 1, 2, 3, 4, 5, 6, 7}) {
          const auto signed_by = [&](double x, int bit) { return (signs & bit) != 0 ? -x : x; };
          const std::vector<HalfAngle> halves = {at(signed_by(a, 1), 1.0), at(signed_by(b, 2), 1e-9),
                                                 at(signed_by(c, 4), 3.0)};
          // A sum may lie on the border itself, where the principal value jumps.
          REQUIRE(std::abs(together(halves) - static_cast<double>(one_by_one(halves))) < 1e-13);
        }
}

TEST_CASE("angles of exact quarters: the plane counts as 0, a straight half angle as a whole turn") {
  CHECK(together({{0.0, -1.0}}) == 0.0);
  CHECK(together({{1.0, 0.0}, {1.0, 0.0}}) == doctest::Approx(2 * std::numbers::pi));
  CHECK(together({{-1.0, 0.0}, {-1.0, 0.0}}) == doctest::Approx(-2 * std::numbers::pi));
  CHECK(together({{1.0, 0.0}, {1.0, 0.0}, {1.0, 0.0}, {1.0, 0.0}}) == doctest::Approx(4 * std::numbers::pi));
  CHECK(together({}) == 0.0);
}
