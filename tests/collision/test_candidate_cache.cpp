// The candidate cache of a workspace never changes a result.
#include <algorithm>
#include <cstring>
#include <limits>
#include <vector>

#include <Eigen/Geometry>

#include <doctest/doctest.h>

#include "scenes.hpp"

namespace {

using namespace bodice_test;
using bodice::collision::Collider;
using bodice::collision::Contact;
using bodice::collision::Workspace;
using bodice::engine::Random;

constexpr float kAll = std::numeric_limits<float>::infinity();

/// Many small ellipsoids: many points are about as near to one as to the next.
bodice::proxy::BodyProxy crowd(bool relief, int count) {
  auto data = data_of(random_ellipsoids(81, count, 0.4, 0.03, 0.15));
  return proxy_of(relief ? with_relief(std::move(data), 9, 0.002, 82) : data);
}

/// Particles for which neighbors in space are neighbors in the arrays.
Cloud lattice(int side) {
  Random random(83);
  Cloud cloud;
  for (int i = 0; i < side * side * side; ++i) {
    const Vec3 cell(i % side, i / side % side, i / (side * side));
    cloud.add(1.1 * (cell / side - Vec3::Constant(0.5)) + random_vector(random, 0.3 / side));
  }
  return cloud;
}

void scatter(Random& random, double step_m, Cloud& cloud) {
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Vec3 p = cloud.position(i) + step_m * random_direction(random);
    cloud.x[i] = static_cast<float>(p.x());
    cloud.y[i] = static_cast<float>(p.y());
    cloud.z[i] = static_cast<float>(p.z());
  }
}

void turn(double angle_rad, std::vector<Ellipsoid>& shapes) {
  const Mat3 by = Eigen::AngleAxisd(angle_rad, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  for (Ellipsoid& e : shapes) {
    e.center = by * e.center;
    e.axes = by * e.axes;
  }
}

std::vector<Ellipsoid> shapes_of(const bodice::proxy::BodyProxy& proxy) {
  std::vector<Ellipsoid> shapes;
  for (const auto& e : proxy.ellipsoids()) shapes.push_back(e.shape);
  return shapes;
}

/// Number of results that differ with a workspace from those without.
int differences(const Collider& collider, Cloud& cloud, Workspace& workspace, float within_m) {
  std::vector<Contact> fresh(cloud.size()), cached(cloud.size());
  collider.query({}, cloud.particles(), fresh, {.within_m = within_m});
  collider.query({}, cloud.particles(), cached, workspace, {.within_m = within_m});
  int differ = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i)
    differ += std::memcmp(&fresh[i], &cached[i], sizeof(Contact)) != 0;
  return differ;
}

/// Number of differing results over some calls; `change` (number of the call) is called after each.
template <class Change>
int differences_over(int calls, const Collider& collider, Cloud& cloud, Change&& change) {
  Workspace workspace;
  int differ = 0;
  for (int call = 0; call < calls; ++call) {
    differ += differences(collider, cloud, workspace, kAll);
    change(call);
  }
  return differ;
}

/// Number of particles that a response with a workspace moves differently from one without; the cloud stays
/// unchanged.
int response_differences(const Collider& collider, const Cloud& cloud, Workspace& workspace,
                         const bodice::collision::ResolveOptions& options) {
  Cloud fresh = cloud, cached = cloud;
  const auto one = collider.resolve({}, fresh.particles(), options);
  const auto other = collider.resolve({}, cached.particles(), options, workspace);
  CHECK(one.contacts == other.contacts);
  CHECK(one.deepest_m == other.deepest_m);
  int differ = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i)
    differ += fresh.position(i) != cached.position(i) || fresh.velocity(i) != cached.velocity(i);
  return differ;
}

/// The y at which a point of the y axis is equally far from the first and the second ellipsoid.
double equally_near_y(const std::vector<Ellipsoid>& shapes) {
  double low = -0.1, high = 0.3;
  for (int i = 0; i < 60; ++i) {
    const Vec3 p(0.0, 0.5 * (low + high), 0.0);
    const double first = bodice::geometry::closest_point(shapes[0], p).signed_distance;
    (first < bodice::geometry::closest_point(shapes[1], p).signed_distance ? low : high) = p.y();
  }
  return low;
}

}  // namespace

TEST_CASE("cached candidates change no bit of a query while particles wander" * doctest::test_suite("long")) {
  for (const bool relief : {false, true})
    for (const double step_m : {0.0, 2e-4, 1e-3, 4e-3, 0.05}) {
      CAPTURE(relief);
      CAPTURE(step_m);
      const Collider collider(crowd(relief, 60));
      Random random(84);
      Cloud cloud = lattice(24);
      Workspace workspace;
      for (int call = 0; call < 9; ++call) {
        const float within_m = call % 3 == 0 ? kAll : call % 3 == 1 ? 0.01f : 0.0f;
        CHECK(differences(collider, cloud, workspace, within_m) == 0);
        scatter(random, step_m, cloud);
      }
    }
}

TEST_CASE("cached candidates change no bit of a query while all particles drift in one direction" *
          doctest::test_suite("long")) {
  // All particles of a batch pass from one ellipsoid to another at once.
  const Collider collider(crowd(false, 200));
  Cloud cloud = lattice(20);
  const auto drift = [&](int) {
    for (float& x : cloud.x) x += 7e-4f;
  };
  CHECK(differences_over(60, collider, cloud, drift) == 0);
}

TEST_CASE("cached candidates change no bit of a query while the proxy moves" * doctest::test_suite("long")) {
  for (const bool relief : {false, true}) {
    const auto proxy = crowd(relief, 60);
    Collider collider(proxy);
    std::vector<Ellipsoid> shapes = shapes_of(proxy);
    Cloud cloud = lattice(20);
    const auto move = [&](int call) {
      turn(call % 10 == 9 ? 0.3 : 1e-3, shapes);
      collider.move_to(shapes, 0.01);
    };
    CHECK(differences_over(40, collider, cloud, move) == 0);
  }
}

TEST_CASE("cached candidates change no bit of a response while particles wander") {
  for (const bool relief : {false, true}) {
    const Collider collider(crowd(relief, 60));
    Random random(87);
    Cloud cloud = lattice(16);
    Workspace workspace;
    for (int call = 0; call < 5; ++call) {
      CHECK(response_differences(collider, cloud, workspace, {.thickness_m = 0.001f}) == 0);
      scatter(random, 1e-3, cloud);
    }
  }
}

TEST_CASE("cached candidates change no bit of a response while thickness, particles and proxy change") {
  for (const bool relief : {false, true}) {
    const auto proxy = crowd(relief, 60);
    Collider collider(proxy);
    std::vector<Ellipsoid> shapes = shapes_of(proxy);
    Cloud cloud = lattice(16);
    Workspace workspace;
    int differ = 0;
    for (int call = 0; call < 30; ++call) {
      // A larger clearance reaches ellipsoids that a smaller one did not need.
      const float thickness_m = call % 3 == 0 ? 0.0f : call % 3 == 1 ? 0.02f : 0.001f;
      differ += response_differences(collider, cloud, workspace, {.thickness_m = thickness_m});
      for (float& x : cloud.x) x += 1e-3f;
      if (call % 2 == 0) continue;
      turn(call == 15 ? 0.3 : 2e-3, shapes);
      collider.move_to(shapes, 0.01);
    }
    CHECK(differ == 0);
  }
}

TEST_CASE("a relief blend is summed in the same order, whichever candidate was found first") {
  // One ball lies in the mirror plane of two others, so that both are equally far there, and the one listed
  // last is third in the sum. The first particles are near only one of them, so that the search finds it
  // before the other.
  for (const bool swapped : {false, true}) {
    std::vector<Ellipsoid> shapes(3);
    for (Ellipsoid& e : shapes) e.radii.setConstant(0.1);
    shapes[0].center = Vec3(0.0, -0.1, 0.0);
    shapes[1].center = Vec3(swapped ? 0.125 : -0.125, 0.0375, 0.0);
    shapes[2].center = Vec3(-shapes[1].center.x(), 0.0375, 0.0);
    const Collider collider(proxy_of(with_relief(data_of(shapes), 9, 0.002, 88)));
    Random random(89);
    Cloud cloud;
    for (int i = 0; i < 32; ++i)
      cloud.add(Vec3(-0.22, 0.12, 0.0) + random_vector(random, 0.01) - collider.origin());
    // These particles are on the mirror plane where all three are about as near, on the same side as the
    // first particles.
    for (int i = 0; i < 224; ++i) {
      const double y = random.uniform(-1e-3, 1e-3), z = random.uniform(-1e-3, 1e-3);
      cloud.add(Vec3(0.0, y + equally_near_y(shapes), z) - collider.origin());
    }
    CAPTURE(swapped);
    CHECK(differences_over(3, collider, cloud, [](int) {}) == 0);
  }
}

TEST_CASE("one workspace serves several colliders and clouds in turns without changing a bit" *
          doctest::test_suite("long")) {
  const Collider first(crowd(false, 60)), second(crowd(true, 60)), third(crowd(false, 200));
  Cloud large = lattice(14), small = lattice(9);
  Workspace workspace;
  int differ = 0;
  for (int call = 0; call < 4; ++call)
    for (Cloud* cloud : {&large, &small})
      for (const Collider* collider : {&first, &second, &third})
        differ += differences(*collider, *cloud, workspace, kAll);
  CHECK(differ == 0);
}

TEST_CASE("particles that are not finite do not corrupt the candidate cache") {
  const Collider collider(crowd(false, 60));
  Cloud cloud = lattice(14);
  Workspace workspace;
  int differ = 0;
  for (int call = 0; call < 6; ++call) {
    Cloud now = cloud;
    if (call % 2 == 1) now.x[700] = std::numeric_limits<float>::quiet_NaN(), now.y[30] = 1e20f;
    differ += differences(collider, now, workspace, kAll);
  }
  CHECK(differ == 0);
}

TEST_CASE("cached candidates change no bit of a query at any scale of coordinates") {
  for (const double scale : {1e-6, 1e-3, 1e6}) {
    CAPTURE(scale);
    auto data = data_of(random_ellipsoids(85, 40, 0.4 * scale, 0.03 * scale, 0.15 * scale));
    const Collider collider(proxy_of(data));
    Random random(86);
    Cloud cloud;
    for (int i = 0; i < 2000; ++i) cloud.add(random_vector(random, 0.5 * scale));
    const auto wander = [&](int) { scatter(random, 1e-3 * scale, cloud); };
    CHECK(differences_over(6, collider, cloud, wander) == 0);
  }
}
