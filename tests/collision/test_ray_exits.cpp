// The fallbacks that cannot fail: ray exits, and the return along the path.
#include <doctest/doctest.h>

#include "exact/ray_exits.hpp"
#include "model/tolerances.hpp"
#include "scenes.hpp"

using namespace bodice;
using namespace bodice::collision;
using namespace bodice_test;

TEST_CASE("a ray exit is clear of every ellipsoid, wherever the ray starts") {
  for (const double clearance_m : {0.0, 0.003})
    for (const std::uint64_t seed : {1u, 2u, 3u, 4u}) {
      const auto shapes = random_ellipsoids(seed, 12, 0.2, 0.02, 0.3);
      const UnionField field(shapes);
      engine::Random random(seed);
      int ended = 0, clear = 0;
      for (int i = 0; i < 2000; ++i) {
        const Vec3 p = random_vector(random, 0.3);
        const auto out = exit_along_ray(field, p, random_direction(random), clearance_m,
                                        std::numeric_limits<double>::infinity());
        ended += out.has_value();
        clear += out && brute_force(shapes, *out).signed_distance >= clearance_m;
      }
      CAPTURE(clearance_m);
      CAPTURE(seed);
      CHECK(ended == 2000);
      CHECK(clear == 2000);
    }
}

namespace {

/// Parameter at which p + t direction has left all shapes by the clearance, by bisection; the distance to a
/// convex shape is convex along the ray.
double first_exit_m(const std::vector<Ellipsoid>& shapes, const Vec3& p, const Vec3& direction,
                    double clearance_m) {
  const auto below = [&](const Ellipsoid& e, double t) {
    return geometry::closest_point(e, p + t * direction).signed_distance < clearance_m;
  };
  double t = 0.0;
  for (bool left = true; left;) {
    left = false;
    for (const Ellipsoid& e : shapes) {
      if (!below(e, t)) continue;
      left = true;
      double in = t, out = t + 10.0;
      for (int i = 0; i < 60; ++i) (below(e, 0.5 * (in + out)) ? in : out) = 0.5 * (in + out);
      t = out;
    }
  }
  return t;
}

}  // namespace

TEST_CASE("a ray exit is the first clear point of the ray, however flat the ray leaves an ellipsoid") {
  for (const double clearance_m : {0.0, 0.003}) {
    const auto shapes = random_ellipsoids(9, 12, 0.2, 0.02, 0.3);
    const UnionField field(shapes);
    engine::Random random(9);
    double farthest_m = 0.0;
    for (int i = 0; i < 2000; ++i) {
      const Vec3 p = random_vector(random, 0.3), direction = random_direction(random);
      const auto out =
          exit_along_ray(field, p, direction, clearance_m, std::numeric_limits<double>::infinity());
      REQUIRE(out);
      farthest_m = std::max(farthest_m, (*out - p).norm() - first_exit_m(shapes, p, direction, clearance_m));
    }
    CAPTURE(clearance_m);
    CHECK(farthest_m < 1e-3);
  }
}

TEST_CASE("a push that cutting planes do not settle is at most a few times as long as the shortest ray exit" *
          doctest::test_suite("long")) {
  const auto shapes = random_ellipsoids(12, 40, 0.4, 0.06, 0.25);
  const UnionField field(shapes);
  for (const double h_m : {0.0, 0.003}) {
    const Collider collider(proxy_of(h_m > 0.0 ? with_relief(data_of(shapes), 16, h_m, 5) : data_of(shapes)));
    engine::Random random(3);
    Cloud cloud;
    for (int i = 0; i < 20000; ++i) cloud.add(random_vector(random, 0.5) - collider.origin());
    const Cloud before = cloud;
    const ContactReport report = collider.resolve({}, cloud.particles(), {});
    double worst = 0.0;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const Vec3 p = before.position(i) + collider.origin();
      const double push_m = (cloud.position(i) - before.position(i)).norm();
      if (!(push_m > 0.01)) continue;
      double ray_m = std::numeric_limits<double>::infinity();
      for (int k = 0; k < 100; ++k) {
        const auto out = exit_along_ray(field, p, random_direction(random), 2.0 * h_m, ray_m);
        if (out) ray_m = std::min(ray_m, (*out - p).norm());
      }
      worst = std::max(worst, push_m / ray_m);
    }
    CAPTURE(h_m);
    CHECK(report.fallbacks >= 50);
    CHECK(report.unresolved == 0);
    CHECK(worst < kLongestPush);
  }
}

TEST_CASE("a particle leaves a fold in another direction where rays along all normals graze a surface") {
  // A fold between two balls along x. A needle under it is nearly straight over the fold's length, so that
  // both exits from the fold run within the clearance of the needle.
  constexpr double kThickness_m = 0.003;
  std::vector<Ellipsoid> shapes(3);
  for (const int k : {0, 1}) {
    shapes[static_cast<std::size_t>(k)].radii.setConstant(0.1);
    shapes[static_cast<std::size_t>(k)].center.x() = k == 0 ? -0.099 : 0.099;
  }
  shapes[2].radii = Vec3(40.0, 0.05, 0.05);
  shapes[2].center.z() = -0.05 - kThickness_m + 1e-4;
  const Collider collider(proxy_of(shapes));
  Cloud cloud;
  cloud.add(Vec3(0.0004, 0.0, 0.0) - collider.origin());
  const ContactReport report =
      collider.resolve({}, cloud.particles(), {.thickness_m = static_cast<float>(kThickness_m)});
  CHECK(report.fallbacks == 1);
  CHECK(report.unresolved == 0);
  CHECK(report.pinched == 0);
  CHECK(brute_force(shapes, cloud.position(0) + collider.origin()).signed_distance > kThickness_m - 2e-5);
  CHECK(std::abs(cloud.x[0]) < 0.01f);
}

TEST_CASE("a path that begins in contact is followed even if rounding puts its start inside") {
  std::vector<Ellipsoid> shapes(1);
  shapes[0].radii = Vec3(0.1, 0.07, 0.05);
  shapes[0].center = Vec3(0.3, 0.2, 0.1);
  shapes.push_back(shapes[0]);  // puts the local frame's origin elsewhere
  shapes[1].center = -shapes[0].center;
  const Collider collider(proxy_of(shapes));
  engine::Random random(5);
  Cloud cloud;
  std::vector<Vec3> begins;
  int inside = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 unit = random_direction(random);
    const Vec3 middle = shapes[0].center - collider.origin();
    cloud.add_safe(middle + shapes[0].radii.cwiseProduct(unit));
    const Vec3 begin(double{cloud.sx.back()}, double{cloud.sy.back()}, double{cloud.sz.back()});
    inside += geometry::level(shapes[0], begin + collider.origin()) < 1.0;
    // The path leads through the center and out of the other side, 1 to 100 times as far.
    cloud.add(middle - random.uniform(1.0, 100.0) * (begin - middle));
    begins.push_back(begin - middle);
  }
  REQUIRE(inside > 500);
  const ContactReport report = collider.resolve({}, cloud.particles(), {});
  CHECK(report.unresolved == 0);
  int through = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i)
    through += (cloud.position(i) + collider.origin() - shapes[0].center).dot(begins[i]) < 0.0;
  CHECK(through == 0);
}
