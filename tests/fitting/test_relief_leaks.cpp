#include <doctest/doctest.h>

#include <bodice/engine/random.hpp>
#include <bodice/fitting/fit.hpp>
#include <bodice/geometry/mesh_distance.hpp>
#include <bodice/proxy/proxy_distance.hpp>

#include "shapes.hpp"

using namespace bodice;
using fitting_test::Skin;
using geometry::Vec3;

namespace {

/// An arm pressed into a torso by `depth_m`; a few millimeters bury a handful of vertices of each.
Skin pressed_together(double depth_m) {
  Skin skin;
  const geometry::Mat3 upright = geometry::Mat3::Identity();
  fitting_test::add_ellipsoid(skin, {Vec3(0, 0.5, 0), upright, Vec3(0.16, 0.40, 0.11)}, body::Part::kTorsoUL);
  fitting_test::add_ellipsoid(skin, {Vec3(0.205 - depth_m, 0.5, 0), upright, Vec3(0.045, 0.30, 0.05)},
                              body::Part::kUpperArmL);
  skin.stature_m = 1.0;
  return skin;
}

}  // namespace

TEST_CASE("relief: limbs that dip into each other open no hole, and the air between them stays air" *
          doctest::test_suite("long")) {
  for (const double depth_m : {0.004, 0.012}) {
    CAPTURE(depth_m);
    const Skin skin = pressed_together(depth_m);
    const geometry::MeshDistance distance({}, skin.mesh);
    fitting::FitOptions options;
    options.tier = proxy::Tier::kRelief;
    options.max_ellipsoids = 8;
    auto view = skin.view();
    view.distance = &distance;
    const auto result = fitting::fit({}, view, options);
    REQUIRE(result.ok());
    engine::Random random(31);
    const geometry::Box box = geometry::bounding_box(skin.mesh.positions);
    int deep = 0, leaks = 0, far = 0, ghosts = 0;
    for (int i = 0; i < 20000; ++i) {
      const Vec3 u(random.uniform(), random.uniform(), random.uniform());
      const Vec3 p = box.low + u.cwiseProduct(box.size());
      const double s = distance.closest_point(p).signed_distance;
      const double f = proxy::proxy_distance(result->proxy, p).distance;
      if (s < -0.006) ++deep, leaks += f > 0.0;
      if (s > 0.010) ++far, ghosts += f < 0.0;
    }
    CHECK(deep > 5000);
    CHECK(leaks == 0);
    CHECK(far > 1000);
    CHECK(ghosts == 0);
  }
}
