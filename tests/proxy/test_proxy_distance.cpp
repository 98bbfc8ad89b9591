#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include <bodice/engine/random.hpp>
#include <bodice/geometry/smallest_turn.hpp>
#include <bodice/proxy/proxy_distance.hpp>

using namespace bodice;
using geometry::Vec3;

namespace {

Vec3 random_unit(engine::Random& random) {
  return Vec3(random.normal(), random.normal(), random.normal()).normalized();
}

/// Two overlapping ellipsoids with smooth random tables; border nodes for one direction have the same bytes.
proxy::BodyProxy::Data relief_pair() {
  proxy::BodyProxy::Data data;
  data.tier = proxy::Tier::kRelief;
  data.stature_m = 1.7;
  data.ellipsoids.resize(2);
  data.ellipsoids[0].shape.radii = Vec3(0.10, 0.20, 0.08);
  data.ellipsoids[1].shape.radii = Vec3(0.12, 0.09, 0.10);
  data.ellipsoids[1].shape.center = Vec3(0.11, 0.08, 0.0);
  constexpr int n = 12;
  for (std::uint32_t k = 0; k < 2; ++k) {
    data.relief.push_back({n, 0.006f, -0.003f, 0.004f, -0.002f, k * n * n});
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        // Values are functions of the direction, so that nodes for one direction have the same bytes.
        const Vec3 w = proxy::octahedral_direction(2.0 * i / (n - 1) - 1.0, 2.0 * j / (n - 1) - 1.0);
        const auto byte = [](double v) { return static_cast<std::uint8_t>(std::lround(127.5 * (1.0 + v))); };
        data.texels.push_back({byte(w.x() * w.y() + 0.3 * w.z()), byte(w.z() * w.x())});
      }
  }
  return data;
}

}  // namespace

TEST_CASE("octahedral map: its inverse returns every direction, also on the seams") {
  engine::Random random(1);
  for (int i = 0; i < 2000; ++i) {
    Vec3 w = random_unit(random);
    if (i % 3 == 0) w.z() = 0.0;
    if (i % 7 == 0) w.x() = 0.0;
    w.normalize();
    const auto [x, y] = proxy::octahedral_map(w);
    CHECK(std::abs(x) <= 1.0 + 1e-12);
    CHECK((proxy::octahedral_direction(x, y) - w).norm() < 1e-12);
  }
}

TEST_CASE("octahedral map: what has no direction has a position, too") {
  for (const double none : {0.0, std::numeric_limits<double>::quiet_NaN()}) {
    const auto [x, y] = octahedral_map(Vec3::Constant(none));
    CHECK(x == 0.0);
    CHECK(y == 0.0);
    const TableStencil stencil = table_stencil(Vec3::Constant(none), 8);
    for (const std::uint32_t texel : stencil.node) CHECK(texel < 64);
  }
}

TEST_CASE("proxy distance: without tables it is the least of the exact distances") {
  proxy::BodyProxy::Data data = relief_pair();
  data.relief.clear();
  data.margin_m = 0.002;
  engine::Random random(2);
  for (int i = 0; i < 500; ++i) {
    const Vec3 p(random.uniform(-0.4, 0.4), random.uniform(-0.4, 0.4), random.uniform(-0.4, 0.4));
    double least = 1e300;
    for (const auto& e : data.ellipsoids)
      least = std::min(least, geometry::closest_point(e.shape, p).signed_distance);
    CHECK(proxy::proxy_distance(data, p).distance == doctest::Approx(least - 0.002).epsilon(1e-12));
  }
}

TEST_CASE("proxy distance: no nearest ellipsoid is missed, however thin and turned") {
  engine::Random random(6);
  int owners_not_nearest_by_center = 0;
  for (int set = 0; set < 40; ++set) {
    proxy::BodyProxy::Data data;
    data.ellipsoids.resize(30);
    for (proxy::ProxyEllipsoid& e : data.ellipsoids) {
      e.shape.center = 0.3 * random_unit(random);
      e.shape.axes = geometry::smallest_turn(Vec3::UnitZ(), random_unit(random)).toRotationMatrix();
      for (int j = 0; j < 3; ++j) e.shape.radii[j] = std::exp(random.uniform(std::log(1e-3), std::log(0.4)));
    }
    for (int i = 0; i < 100; ++i) {
      const Vec3 p = random.uniform(0.0, 0.8) * random_unit(random);
      double least = 1e300;
      std::size_t nearest = 0, nearest_center = 0;
      for (std::size_t k = 0; k < data.ellipsoids.size(); ++k) {
        const geometry::Ellipsoid& e = data.ellipsoids[k].shape;
        const double d = geometry::closest_point(e, p).signed_distance;
        if (d < least) least = d, nearest = k;
        if ((p - e.center).norm() < (p - data.ellipsoids[nearest_center].shape.center).norm())
          nearest_center = k;
      }
      const proxy::ProxyDistance found = proxy::proxy_distance(data, p);
      CHECK(found.distance == least);
      CHECK(found.owner == nearest);
      owners_not_nearest_by_center += nearest != nearest_center;
    }
  }
  CHECK(owners_not_nearest_by_center > 1000);  // the sets contain cases that need the bound
}

TEST_CASE("proxy distance: relief is continuous across owners and seams") {
  const proxy::BodyProxy::Data data = relief_pair();
  engine::Random random(3);
  double jump = 0.0;
  int changes = 0;
  for (int i = 0; i < 4000; ++i) {
    const Vec3 p = Vec3(0.05, 0.05, 0.0) + random.uniform(0.05, 0.25) * random_unit(random);
    const Vec3 q = p + 1e-6 * random_unit(random);
    const auto a = proxy::proxy_distance(data, p), b = proxy::proxy_distance(data, q);
    if (a.distance < -0.03) continue;  // the closest point itself jumps across an ellipsoid's medial disk
    changes += a.owner != b.owner;
    jump = std::max(jump, std::abs(a.distance - b.distance));
  }
  CHECK(jump < 4e-6);  // steps of a micrometer, slopes below 4
  // Points are found on the border between two owners, by bisection to a nanometer.
  for (int i = 0; i < 200; ++i) {
    Vec3 p = 0.2 * random_unit(random), q = Vec3(0.11, 0.08, 0.0) + 0.2 * random_unit(random);
    const auto owner = proxy::proxy_distance(data, p).owner;
    if (proxy::proxy_distance(data, q).owner == owner) continue;
    while ((p - q).norm() > 1e-9) {
      const Vec3 m = 0.5 * (p + q);
      (proxy::proxy_distance(data, m).owner == owner ? p : q) = m;
    }
    ++changes;
    CHECK(std::abs(proxy::proxy_distance(data, p).distance - proxy::proxy_distance(data, q).distance) < 1e-7);
  }
  CHECK(changes > 20);
}

TEST_CASE("proxy distance: the gradient of a single table matches finite differences") {
  proxy::BodyProxy::Data data = relief_pair();
  data.ellipsoids.resize(1);
  data.relief.resize(1);
  engine::Random random(4);
  int checked = 0, off = 0;
  for (int i = 0; i < 500; ++i) {
    const Vec3 u = random_unit(random);
    const Vec3 p = (1.0 + random.uniform(-0.05, 0.1)) * data.ellipsoids[0].shape.radii.cwiseProduct(u);
    const double h = 1e-7;
    Vec3 slope;
    for (int j = 0; j < 3; ++j)
      slope[j] = (proxy::proxy_distance(data, p + h * Vec3::Unit(j)).distance -
                  proxy::proxy_distance(data, p - h * Vec3::Unit(j)).distance) /
                 (2.0 * h);
    ++checked;
    // The difference straddles a cell's edge at a few points, where the gradient jumps.
    off += (slope.normalized() - proxy::proxy_distance(data, p).normal).norm() > 1e-4;
  }
  CHECK(checked == 500);
  CHECK(off <= 5);
}

TEST_CASE("proxy distance: it scales with the body") {
  proxy::BodyProxy::Data small = relief_pair(), large = small;
  const double s = 1000.0;
  large.stature_m *= s;
  for (auto& e : large.ellipsoids) e.shape.center *= s, e.shape.radii *= s;
  for (auto& t : large.relief) {
    t.h_scale_m *= 1000.0f, t.h_offset_m *= 1000.0f, t.a_scale *= 1000.0f, t.a_offset *= 1000.0f;
  }
  engine::Random random(6);
  for (int i = 0; i < 200; ++i) {
    const Vec3 p = 0.3 * random_unit(random);
    CHECK(proxy::proxy_distance(large, s * p).distance / s ==
          doctest::Approx(proxy::proxy_distance(small, p).distance).epsilon(1e-5));
  }
}

TEST_CASE("proxy distance: an empty proxy is infinitely far") {
  CHECK(std::isinf(proxy::proxy_distance(proxy::BodyProxy::Data{}, Vec3::Zero()).distance));
}
