#include <doctest/doctest.h>

#include <numbers>

#include <bodice/engine/random.hpp>
#include <bodice/geometry/ellipsoid.hpp>
#include <bodice_test/extremes.hpp>

using namespace bodice::geometry;
using bodice_test::extreme_ellipsoids;

TEST_CASE("a sphere has the closed forms") {
  const Ellipsoid sphere{Vec3(1, 2, 3), Mat3::Identity(), Vec3::Constant(2.0)};
  CHECK(volume(sphere) == doctest::Approx(32.0 / 3.0 * std::numbers::pi));
  CHECK(level(sphere, Vec3(1, 2, 5)) == doctest::Approx(1.0));
  CHECK(level(sphere, sphere.center) == 0.0);
  CHECK((radial_projection(sphere, Vec3(4, 2, 3)) - Vec3(3, 2, 3)).norm() < 1e-15);
}

TEST_CASE("the box is tight: every surface point is inside, and each face is touched") {
  for (const auto& extreme : extreme_ellipsoids()) {
    CAPTURE(extreme.name);
    const Ellipsoid& e = extreme.shape;
    const Box box = bounding_box(e);
    const double slack = 1e-14 * (e.radii.maxCoeff() + e.center.norm());
    for (int k = 0; k < 3; ++k) {
      // The support point in direction e_k, independently: c + Q^-1 e_k / sqrt(e_k Q^-1 e_k).
      const Mat3 inverse_q = e.axes * e.radii.cwiseAbs2().asDiagonal() * e.axes.transpose();
      const Vec3 support = inverse_q.col(k) / std::sqrt(inverse_q(k, k));
      CHECK(std::abs(box.high[k] - (e.center[k] + support[k])) <= slack);
      CHECK(std::abs(box.low[k] - (e.center[k] - support[k])) <= slack);
    }
    bodice::engine::Random random(1);
    for (int i = 0; i < 200; ++i) {
      const Vec3 u = Vec3(random.normal(), random.normal(), random.normal()).normalized();
      const Vec3 p = e.center + e.axes * e.radii.cwiseProduct(u);
      CHECK(((p - box.low).array() >= -slack).all());
      CHECK(((box.high - p).array() >= -slack).all());
    }
  }
}

TEST_CASE("the radial projection lies on the surface, on the ray, and is defined at the center") {
  for (const auto& extreme : extreme_ellipsoids()) {
    CAPTURE(extreme.name);
    const Ellipsoid& e = extreme.shape;
    // The error of the level that rounding the center's coordinates alone causes, in the thinnest direction.
    const double noise = 1e-12 + 1e-15 * e.center.norm() / e.radii.minCoeff() * 8.0;
    for (const Vec3& query : bodice_test::hostile_queries(e)) {
      const Vec3 p = radial_projection(e, query);
      REQUIRE(p.allFinite());
      const Vec3 w = (e.axes.transpose() * (p - e.center)).cwiseQuotient(e.radii);
      CHECK(std::abs(w.norm() - 1.0) <= noise + 1e-15 * e.radii.maxCoeff() / e.radii.minCoeff() * 8.0);
    }
    int shortest = 0;
    e.radii.minCoeff(&shortest);
    CHECK(radial_projection(e, e.center) == e.center + e.radii[shortest] * e.axes.col(shortest));
  }
}

TEST_CASE("axes are ordered by falling radius, and equal ones by their numbers") {
  const double radii[] = {0.1, 0.2, 0.3};
  for (const double x : radii)
    for (const double y : radii)
      for (const double z : radii) {
        const Vec3 r(x, y, z);
        CAPTURE(r.transpose());
        const std::array<int, 3> axes = axes_by_radius(r);
        for (int i = 0; i < 2; ++i) {
          const int a = axes[static_cast<std::size_t>(i)], b = axes[static_cast<std::size_t>(i + 1)];
          CHECK((r[a] > r[b] || (r[a] == r[b] && a < b)));
        }
      }
}
