// The closest point against a reference in 113-bit arithmetic that shares nothing with it but the problem:
// plain bisection of Eberly's equation in t, 400 halvings.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include <bodice/engine/random.hpp>
#include <bodice/geometry/ellipsoid.hpp>
#include <bodice_test/extremes.hpp>

using namespace bodice::geometry;

namespace {

__extension__ typedef __float128 Quad;
using Quad3 = std::array<Quad, 3>;

Quad quad_sqrt(Quad x) {
  if (!(x > 0)) return 0;
  Quad root = static_cast<Quad>(std::sqrt(static_cast<long double>(x)));
  if (!(root > 0)) return 0;
  for (int i = 0; i < 3; ++i) root = (root + x / root) / 2;
  return root;
}

Quad3 to_local(const Ellipsoid& e, const Vec3& p) {
  Quad3 y{};
  for (int j = 0; j < 3; ++j)
    for (int k = 0; k < 3; ++k)
      y[j] += static_cast<Quad>(e.axes(k, j)) * (static_cast<Quad>(p[k]) - static_cast<Quad>(e.center[k]));
  return y;
}

/// The unsigned distance from y to the surface, and the closest point in the first octant.
struct Reference {
  Quad distance;
  Quad3 closest;
};

Reference reference(const Ellipsoid& e, const Quad3& y) {
  Quad3 r{}, z{};
  for (int j = 0; j < 3; ++j) {
    r[j] = e.radii[j];
    z[j] = y[j] < 0 ? -y[j] : y[j];
  }
  const int pole = static_cast<int>(std::min_element(r.begin(), r.end()) - r.begin());
  auto w2 = [&](Quad u, int j) {
    const Quad denominator = u + (r[j] - r[pole]) * (r[j] + r[pole]);
    if (z[j] == 0) return Quad(0);
    const Quad w = r[j] * z[j] / denominator;
    return w * w;
  };
  auto sum = [&](Quad u) { return w2(u, 0) + w2(u, 1) + w2(u, 2); };
  Quad high = 0;
  for (int j = 0; j < 3; ++j) high += r[j] * z[j];
  Quad low = 0;
  Quad3 w{};
  // The unknown is u = t + r_min^2; bisection is logarithmic first, so that tiny roots keep their digits.
  const Quad tiny = high * static_cast<Quad>(1e-1000L);
  const bool above = high > 0 && sum(tiny) > 1;
  if (above) {
    low = tiny;
    for (int i = 0; i < 16000 && high > 4 * low; ++i) {
      const Quad middle = quad_sqrt(low) * quad_sqrt(high);
      (sum(middle) > 1 ? low : high) = middle;
    }
    for (int i = 0; i < 120; ++i) {
      const Quad middle = (low + high) / 2;
      (sum(middle) > 1 ? low : high) = middle;
    }
    for (int j = 0; j < 3; ++j) w[j] = quad_sqrt(w2(high, j));
  } else {
    Quad rest = 1;
    for (int j = 0; j < 3; ++j)
      if (j != pole && z[j] > 0) {
        w[j] = quad_sqrt(w2(0, j));
        rest -= w[j] * w[j];
      }
    w[pole] = quad_sqrt(rest);
  }
  Reference result{};
  for (int j = 0; j < 3; ++j) {
    result.closest[j] = r[j] * w[j];
    result.distance += (z[j] - result.closest[j]) * (z[j] - result.closest[j]);
  }
  result.distance = quad_sqrt(result.distance);
  return result;
}

struct Errors {
  double distance = 0.0, surface = 0.0, normal = 0.0, consistency = 0.0;  // relative to the largest radius
};

Errors errors_of(const Ellipsoid& e, const Vec3& query) {
  const ClosestPoint got = closest_point(e, query);
  REQUIRE(got.point.allFinite());
  REQUIRE(got.normal.allFinite());
  REQUIRE(std::isfinite(got.signed_distance));
  const Quad3 y = to_local(e, query);
  Quad reach = e.radii.maxCoeff();
  Quad level = 0;
  for (int j = 0; j < 3; ++j) {
    reach = std::max(reach, y[j] < 0 ? -y[j] : y[j]);
    level += y[j] / static_cast<Quad>(e.radii[j]) * (y[j] / static_cast<Quad>(e.radii[j]));
  }
  const double scale =
      std::max({static_cast<double>(reach), query.cwiseAbs().maxCoeff(), e.center.cwiseAbs().maxCoeff()});
  const Reference truth = reference(e, y);
  const Quad signed_truth = level < 1 ? -truth.distance : truth.distance;
  Errors errors;
  errors.distance =
      std::abs(static_cast<double>(static_cast<Quad>(got.signed_distance) - signed_truth)) / scale;
  // The distance of the returned point from the surface, to first order.
  const Vec3 w = (e.axes.transpose() * (got.point - e.center)).cwiseQuotient(e.radii);
  const double gradient = w.cwiseQuotient(e.radii).norm() / w.norm();
  errors.surface = std::abs(w.norm() - 1.0) / gradient / scale;
  errors.normal = std::abs(got.normal.norm() - 1.0);
  errors.consistency = std::abs((query - got.point).norm() - std::abs(got.signed_distance)) / scale;
  return errors;
}

void check_errors(const Ellipsoid& e, const Vec3& query) {
  CAPTURE(query);
  const Errors errors = errors_of(e, query);
  CHECK(errors.distance <= 1e-12);
  CHECK(errors.surface <= 1e-12);
  CHECK(errors.normal <= 1e-12);
  CHECK(errors.consistency <= 1e-12);
}

}  // namespace

TEST_CASE("closest_point is exact to 1e-12 on every hostile query of every hostile ellipsoid") {
  for (const auto& extreme : bodice_test::extreme_ellipsoids()) {
    CAPTURE(extreme.name);
    for (const Vec3& query : bodice_test::hostile_queries(extreme.shape)) check_errors(extreme.shape, query);
  }
}

TEST_CASE("closest_point is exact to 1e-12 on random shapes and queries over twelve decades") {
  bodice::engine::Random random(7);
  for (int i = 0; i < 4000; ++i) {
    Ellipsoid e;
    const double aspect = std::pow(10.0, random.uniform(0.0, 6.0));
    for (int k = 0; k < 3; ++k) e.radii[k] = std::pow(aspect, -random.uniform());
    e.radii *= std::pow(10.0, random.uniform(-6.0, 6.0));
    e.axes = Eigen::Quaterniond(random.normal(), random.normal(), random.normal(), random.normal())
                 .normalized()
                 .toRotationMatrix();
    // Queries near the surface, near the middle, near a symmetry plane, and far away.
    Vec3 w = Vec3(random.normal(), random.normal(), random.normal()).normalized();
    w *= std::pow(10.0, random.uniform(-4.0, 2.0));
    if (random.uniform() < 0.3)
      w[static_cast<int>(random.below(3))] *= std::pow(10.0, random.uniform(-300.0, -6.0));
    check_errors(e, e.center + e.axes * e.radii.cwiseProduct(w));
  }
}

TEST_CASE("no sampled surface point is nearer than closest_point") {
  bodice::engine::Random random(3);
  for (const auto& extreme : bodice_test::extreme_ellipsoids()) {
    CAPTURE(extreme.name);
    const Ellipsoid& e = extreme.shape;
    for (int i = 0; i < 20; ++i) {
      const Vec3 w = 1.3 * Vec3(random.normal(), random.normal(), random.normal());
      const Vec3 query = e.center + e.axes * e.radii.cwiseProduct(w);
      const double best = (closest_point(e, query).point - query).norm();
      for (int s = 0; s < 100; ++s) {
        const Vec3 u = Vec3(random.normal(), random.normal(), random.normal()).normalized();
        const Vec3 p = e.center + e.axes * e.radii.cwiseProduct(u);
        REQUIRE((p - query).norm() >= best - 1e-12 * (e.radii.maxCoeff() + e.center.norm()));
      }
    }
  }
}

TEST_CASE("where the closest point is not unique, the documented one is returned") {
  const Ellipsoid e{Vec3::Zero(), Mat3::Identity(), Vec3(3.0, 1.0, 2.0)};
  const ClosestPoint at_center = closest_point(e, Vec3::Zero());
  CHECK(at_center.point == Vec3(0.0, 1.0, 0.0));
  CHECK(at_center.normal == Vec3(0.0, 1.0, 0.0));
  CHECK(at_center.signed_distance == -1.0);
  const ClosestPoint on_disk = closest_point(e, Vec3(0.5, 0.0, -0.3));
  CHECK(on_disk.point[1] > 0.0);
  const ClosestPoint below = closest_point(e, Vec3(0.5, -1e-30, -0.3));
  CHECK(below.point[1] == doctest::Approx(-on_disk.point[1]));
}

TEST_CASE("a sphere's closest point is radial, to the last digits") {
  const Ellipsoid sphere{Vec3(1, 2, 3), Mat3::Identity(), Vec3::Constant(0.5)};
  const Vec3 direction = Vec3(1, -2, 2) / 3.0;
  const ClosestPoint got = closest_point(sphere, sphere.center + 0.8 * direction);
  CHECK((got.normal - direction).norm() < 1e-15);
  CHECK(got.signed_distance == doctest::Approx(0.3).epsilon(1e-14));
}
