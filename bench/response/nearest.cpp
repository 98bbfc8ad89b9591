// Error of the float kernel's closest point. Ellipsoids are random over twelve decades of size and aspect
// ratios up to 1:1000. Particles are random up to three radii away, some of them on symmetry planes and at
// the center. The reference is the solver in double precision, which the geometry suite holds to 1e-12 of a
// long double reference.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include <Eigen/Geometry>

#include <bodice/collision/collider.hpp>
#include <bodice/engine/random.hpp>

#include "modes.hpp"

namespace bench {

using namespace bodice;
using geometry::Vec3;

namespace {

constexpr std::size_t kPerShape = 4096;
constexpr double kBar = 1e-6;

Vec3 direction(engine::Random& random) {
  const double a = random.normal(), b = random.normal();
  return Vec3(a, b, random.normal()).stableNormalized();
}

geometry::Ellipsoid random_shape(engine::Random& random) {
  geometry::Ellipsoid e;
  const double size_m = std::pow(10.0, random.uniform(-6.0, 6.0));
  const double turn = random.uniform(0.0, 3.14);
  e.axes = Eigen::AngleAxisd(turn, direction(random)).toRotationMatrix();
  for (int axis = 0; axis < 3; ++axis) e.radii[axis] = size_m * std::pow(10.0, random.uniform(-3.0, 0.0));
  return e;
}

/// A random point in the ellipsoid's frame, in units of its radii; every eighth lies on a plane, an axis or
/// the center.
Vec3 random_position(engine::Random& random, std::size_t i) {
  Vec3 p = random.uniform(0.0, 3.0) * direction(random);
  for (int axis = 0; i % 8 == 0 && axis < 3; ++axis)
    if (random.below(2) == 0) p[axis] = 0.0;
  return p;
}

/// The largest error so far, and counts over all cases.
struct Worst {
  double relative = 0.0;
  std::size_t above_bar = 0, not_finite = 0, cases = 0;
  Vec3 radii = Vec3::Ones(), position = Vec3::Zero();  ///< of the worst case; position in its frame, meters
};

void compare(const geometry::Ellipsoid& shape, engine::Random& random, Worst& worst) {
  auto proxy = proxy::BodyProxy::make(
      {.tier = proxy::Tier::kSolid, .stature_m = shape.radii.maxCoeff(), .ellipsoids = {{.shape = shape}}});
  if (!proxy.ok()) std::puts(proxy.error().sentence().c_str()), std::exit(1);
  const geometry::Ellipsoid& e = proxy->ellipsoids()[0].shape;
  const collision::Collider collider(*proxy);
  std::vector<float> x(kPerShape), y(kPerShape), z(kPerShape);
  for (std::size_t i = 0; i < kPerShape; ++i) {
    const Vec3 p = e.center - collider.origin() + e.axes * e.radii.cwiseProduct(random_position(random, i));
    x[i] = static_cast<float>(p.x()), y[i] = static_cast<float>(p.y()), z[i] = static_cast<float>(p.z());
  }
  std::vector<collision::Contact> contacts(kPerShape);
  collider.query({}, {.count = kPerShape, .x = x.data(), .y = y.data(), .z = z.data()}, contacts);
  for (std::size_t i = 0; i < kPerShape; ++i) {
    const Vec3 p = collider.origin() + Vec3(double{x[i]}, double{y[i]}, double{z[i]});
    const collision::Contact& c = contacts[i];
    const Vec3 point(double{c.point[0]}, double{c.point[1]}, double{c.point[2]});
    const double truth = geometry::closest_point(e, p).signed_distance;
    // The error is that of the distance, or the distance of the closest point from the surface.
    const double off =
        std::max(std::abs(double{c.signed_distance} - truth),
                 std::abs(geometry::closest_point(e, collider.origin() + point).signed_distance));
    const double relative = off / std::max(e.radii.maxCoeff(), (p - e.center).norm());
    worst.not_finite += !std::isfinite(relative);
    worst.above_bar += relative > kBar;
    if (relative <= worst.relative) continue;
    worst.relative = relative;
    worst.radii = e.radii;
    worst.position = e.axes.transpose() * (p - e.center);
  }
  worst.cases += kPerShape;
}

}  // namespace

bool measure_nearest(std::span<char*> arguments) {
  const auto cases = static_cast<std::size_t>(arguments.empty() ? 1e6 : std::atof(arguments[0]));
  const auto seed = static_cast<std::uint64_t>(arguments.size() < 2 ? 4 : std::atoll(arguments[1]));
  engine::Random random(seed);
  Worst worst;
  while (worst.cases < cases) compare(random_shape(random), random, worst);
  std::printf(
      "| cases | seed | largest relative error (bar 1e-6) | above the bar | not finite (bar 0) "
      "|\n|---|---|---|---|---|\n"
      "| %zu | %llu | %.2e | %zu | %zu |\n",
      worst.cases, static_cast<unsigned long long>(seed), worst.relative, worst.above_bar, worst.not_finite);
  std::printf("the worst: radii %g %g %g m, position %g %g %g m in its frame\n", worst.radii[0],
              worst.radii[1], worst.radii[2], worst.position[0], worst.position[1], worst.position[2]);
  return worst.above_bar == 0 && worst.not_finite == 0;
}

}  // namespace bench
