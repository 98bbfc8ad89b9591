// Closest points at a fixed cost are as exact as promised near the surface, and finite everywhere.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <Eigen/Geometry>

#include <bodice/engine/random.hpp>

#include "base/closest_point_batch.hpp"

using namespace bodice;
using fitting::FloatEllipsoid;
using geometry::Vec3;

namespace {

constexpr double kNearSurface = 1e-5;  // bound on the error near the surface, fraction of the largest radius

struct Points {
  std::vector<float> x, y, z, d;

  void add(const Vec3& p) {
    x.push_back(static_cast<float>(p.x()));
    y.push_back(static_cast<float>(p.y()));
    z.push_back(static_cast<float>(p.z()));
  }
  Vec3 at(std::size_t i) const { return {double{x[i]}, double{y[i]}, double{z[i]}}; }
  fitting::PointArrays arrays() const { return {x.size(), x.data(), y.data(), z.data()}; }
  void measure(const geometry::Ellipsoid& e) {
    d.resize(x.size());
    fitting::batch_distances(FloatEllipsoid(e), arrays(), d.data());
  }
};

geometry::Ellipsoid turned(engine::Random& random, const Vec3& radii) {
  const auto in = [&](double half) { return random.uniform(-half, half); };
  const Vec3 axis = Vec3(in(1), in(1), in(1)).stableNormalized();
  return {Vec3(in(0.5), in(0.5), in(0.5)), Eigen::AngleAxisd(in(3), axis).toRotationMatrix(), radii};
}

}  // namespace

TEST_CASE("closest point batch: near the surface, distances are those of the exact closest point") {
  engine::Random random(31);
  double worst = 0.0;
  for (int trial = 0; trial < 40; ++trial) {
    const auto radius = [&] { return random.uniform(0.05, 0.1); };
    const geometry::Ellipsoid e = turned(random, Vec3(radius(), radius(), radius()));
    Points points;
    for (int i = 0; i < 37; ++i) {
      const auto in = [&] { return random.uniform(-1.0, 1.0); };
      const Vec3 u = Vec3(in(), in(), in()).stableNormalized();
      points.add(e.center + e.axes * e.radii.cwiseProduct(random.uniform(0.9, 1.2) * u));
    }
    points.measure(e);
    for (std::size_t i = 0; i < points.x.size(); ++i) {
      const double truth = geometry::closest_point(e, points.at(i)).signed_distance;
      worst = std::max(worst, std::abs(double{points.d[i]} - truth) / e.radii.maxCoeff());
    }
  }
  CHECK(worst < kNearSurface);
}

TEST_CASE(
    "closest point batch: thin, flat and round ellipsoids give finite distances, from center to far away") {
  engine::Random random(32);
  for (const Vec3& radii : {Vec3(0.1, 0.1, 0.1), Vec3(1e-3, 1e-3, 1e-3), Vec3(1e-3, 1e-3, 1.0),
                            Vec3(1e-3, 1.0, 1.0), Vec3(0.5, 0.01, 0.1)}) {
    const geometry::Ellipsoid e = turned(random, radii);
    Points points;
    points.add(e.center);
    for (int axis = 0; axis < 3; ++axis)
      for (const double times : {1e-6, 0.5, 1.0, 2.0, 100.0})
        points.add(e.center + times * e.radii[axis] * e.axes.col(axis));
    points.measure(e);
    for (std::size_t i = 0; i < points.x.size(); ++i) {
      CAPTURE(radii.transpose());
      CAPTURE(i);
      CHECK(std::isfinite(points.d[i]));
    }
    CHECK(points.d[0] <= 0.0f);
  }
}

TEST_CASE("closest point batch: the tangent at a point lies below the distance everywhere") {
  engine::Random random(33);
  for (int trial = 0; trial < 40; ++trial) {
    const auto radius = [&] { return random.uniform(0.02, 0.2); };
    const geometry::Ellipsoid e = turned(random, Vec3(radius(), radius(), radius()));
    const auto anywhere = [&] {
      const auto in = [&] { return random.uniform(-0.4, 0.4); };
      return Vec3(e.center + Vec3(in(), in(), in()));
    };
    Points points;
    for (int i = 0; i < 37; ++i) points.add(anywhere());
    std::array<std::vector<float>, 4> found;
    for (auto& values : found) values.resize(points.x.size());
    fitting::batch_normals(FloatEllipsoid(e), points.arrays(), found[0].data(), found[1].data(),
                           found[2].data(), found[3].data());
    points.measure(e);
    for (std::size_t i = 0; i < points.x.size(); ++i) {
      CHECK(double{found[0][i]} == doctest::Approx(double{points.d[i]}).epsilon(1e-5));
      const Vec3 normal(double{found[1][i]}, double{found[2][i]}, double{found[3][i]});
      CHECK(normal.norm() == doctest::Approx(1.0).epsilon(1e-5));
      const Vec3 other = anywhere();
      const double tangent = double{found[0][i]} + normal.dot(other - points.at(i));
      CHECK(tangent <= geometry::closest_point(e, other).signed_distance + 1e-5);
    }
  }
}
