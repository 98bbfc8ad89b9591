#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Geometry>

#include <bodice/engine/random.hpp>
#include <bodice/fitting/mvee.hpp>

using namespace bodice;
using fitting::Mvee;
using geometry::Vec3;

namespace {

bool finite(const Mvee& m) {
  return m.ellipsoid.center.allFinite() && m.ellipsoid.axes.allFinite() && m.ellipsoid.radii.allFinite() &&
         m.ellipsoid.radii.minCoeff() > 0.0 && std::isfinite(m.volume_gap) && std::isfinite(m.violation);
}

Vec3 unit_vector(engine::Random& random) {
  Vec3 v;
  do v = Vec3(random.normal(), random.normal(), random.normal());
  while (v.norm() < 1e-3);
  return v.normalized();
}

geometry::Mat3 rotation(engine::Random& random) {
  return Eigen::Quaterniond(random.normal(), random.normal(), random.normal(), random.normal())
      .normalized()
      .toRotationMatrix();
}

/// A small random set of one of eight kinds, among them spheres, lattices with ties, needles, plates and
/// boxes.
std::vector<Vec3> random_set(engine::Random& random) {
  const int n = 4 + static_cast<int>(random.below(60));
  const auto kind = random.below(8);
  const geometry::Mat3 turn = rotation(random);
  const Vec3 offset = kind % 2 ? Vec3(1.0, -2.0, 3.0) : Vec3(Vec3::Zero());
  std::vector<Vec3> points;
  for (int i = 0; i < n; ++i) {
    Vec3 p(random.normal(), random.normal(), random.normal());
    if (kind == 1) p = unit_vector(random);
    if (kind == 2 || kind == 3)
      p = Vec3(double(random.below(3)), double(random.below(3)), double(random.below(kind)));
    if (kind == 4) p = p.cwiseProduct(Vec3(1.0, 1e-3, 1e-5));
    if (kind == 5) p = p.cwiseProduct(Vec3(1.0, 1.0, 1e-6));
    if (kind == 6) p = Vec3(random.uniform(), random.uniform(), random.uniform());
    if (kind == 7) p = unit_vector(random).cwiseProduct(Vec3(1.0, 0.2, 0.1));
    points.push_back(turn * p + offset);
  }
  return points;
}

}  // namespace

TEST_CASE("mvee: the corners of a box give the ellipsoid known in closed form") {
  std::vector<Vec3> corners;
  const Vec3 half(0.5, 0.2, 0.1), center(1.0, 2.0, 3.0);
  for (int k = 0; k < 8; ++k)
    corners.push_back(center + half.cwiseProduct(Vec3(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1)));
  for (int copies = 1; copies <= 3; ++copies) {
    const Mvee m = fitting::mvee(corners);
    CHECK(m.rank == 3);
    CHECK((m.ellipsoid.center - center).norm() < 1e-8);
    CHECK((m.ellipsoid.radii - std::sqrt(3.0) * half).norm() < 1e-7);
    CHECK(m.volume_gap <= 1e-7);
    const auto copy = corners;  // duplicates change nothing
    corners.insert(corners.end(), copy.begin(), copy.end());
  }
}

TEST_CASE("mvee: points on a known ellipsoid give that ellipsoid, rotated, scaled and far from the origin") {
  engine::Random random(7);
  const geometry::Mat3 turn = rotation(random);
  const Vec3 radii(0.4, 0.15, 0.06);
  std::vector<Vec3> sphere;
  for (int i = 0; i < 500; ++i) {
    const Vec3 v = unit_vector(random);
    sphere.push_back(v);
    sphere.push_back(-v);
  }
  for (const double scale : {1e-6, 1e-3, 1.0, 1e3, 1e6})
    for (const double offset : {0.0, 1e4 * scale}) {
      std::vector<Vec3> points;
      for (const Vec3& v : sphere)
        points.push_back(scale * (turn * radii.cwiseProduct(v)) + Vec3::Constant(offset));
      const Mvee m = fitting::mvee(points);
      const double tolerance = offset > 0 ? 1e-6 : 2e-8;
      // Every point has its opposite, so that the known ellipsoid is the least one and all points lie on it.
      CHECK((m.ellipsoid.radii / scale - radii).norm() < tolerance);
      CHECK(m.violation <= 1e-12);
      CHECK(m.volume_gap <= (offset > 0 ? 1e-5 : 1.01e-7));
    }
}

TEST_CASE("mvee: all of a hundred thousand small sets are certified" * doctest::test_suite("long")) {
  engine::Random random(11);
  int uncertified = 0, not_finite = 0, violated = 0;
  double worst_gap = 0.0;
  for (int trial = 0; trial < 100000; ++trial) {
    const std::vector<Vec3> set = random_set(random);
    const Mvee m = fitting::mvee(set);
    not_finite += !finite(m);
    violated += m.violation > 1e-9;
    // In flat sets, rounding across the plane may take up to 1e-6 of a level. A set that is nearly flat has
    // coordinates that are rounded by a share of its thickness: one set here is 4 nm thick, 3 m from the
    // origin.
    double coordinate = 0.0;
    for (const Vec3& p : set) coordinate = std::max(coordinate, p.cwiseAbs().maxCoeff());
    const double rounding =
        4.0 * std::numeric_limits<double>::epsilon() * coordinate / m.ellipsoid.radii.minCoeff();
    const double allowed = m.rank == 3 ? 1.01e-7 + rounding : 4e-6;
    uncertified += !(m.volume_gap <= allowed);
    worst_gap = std::max(worst_gap, m.volume_gap);
  }
  MESSAGE("worst gap " << worst_gap);
  CHECK(not_finite == 0);
  CHECK(violated == 0);
  CHECK(uncertified == 0);
}

TEST_CASE("mvee: flat, collinear, single and empty sets give a thin ellipsoid of the minimum radius") {
  engine::Random random(3);
  const fitting::MveeOptions options{.min_radius_m = 1e-3};
  const geometry::Mat3 turn = rotation(random);
  for (const double scale : {1.0, 100.0}) {
    std::vector<Vec3> plane, line;
    for (int i = 0; i < 50; ++i) {
      plane.push_back(scale * (turn * Vec3(random.normal(), random.normal(), 0.0)));
      line.push_back(scale * (turn * Vec3(random.normal(), 0.0, 0.0)));
    }
    const Mvee flat = fitting::mvee(plane, options), thin = fitting::mvee(line, options);
    CHECK(flat.rank == 2);
    CHECK(flat.ellipsoid.radii[2] == doctest::Approx(1e-3).epsilon(1e-5));
    CHECK(thin.rank == 1);
    CHECK(thin.ellipsoid.radii[1] == doctest::Approx(1e-3).epsilon(1e-5));
    CHECK(flat.violation <= 1e-9);
    CHECK(thin.violation <= 1e-9);
  }
  const std::vector<Vec3> one = {Vec3(1, 2, 3), Vec3(1, 2, 3)};
  const Mvee single = fitting::mvee(one, options);
  CHECK(single.rank == 0);
  CHECK(single.ellipsoid.center == Vec3(1, 2, 3));
  CHECK(single.ellipsoid.radii == Vec3::Constant(1e-3));
  CHECK(finite(fitting::mvee({}, options)));
  CHECK(finite(fitting::mvee(one)));
}

TEST_CASE("mvee: NaN and Inf points are skipped and counted") {
  std::vector<Vec3> points = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
  const Mvee clean = fitting::mvee(points);
  points.insert(points.begin() + 1, Vec3(std::nan(""), 0, 0));
  points.push_back(Vec3(0, std::numeric_limits<double>::infinity(), 0));
  const Mvee dirty = fitting::mvee(points);
  CHECK(dirty.skipped == 2);
  CHECK(dirty.ellipsoid.radii == clean.ellipsoid.radii);
  // An affine map of the regular simplex maps its ellipsoid, and the center to the mean of the corners.
  CHECK(clean.ellipsoid.center.isApprox(Vec3::Constant(0.25), 1e-7));
}

TEST_CASE("mvee: rotated needles of aspect up to 1e15 give finite ellipsoids that hold their points") {
  engine::Random random(5);
  for (const double aspect : {1e3, 1e6, 1e9, 1e12, 1e15}) {
    const geometry::Mat3 turn = rotation(random);
    std::vector<Vec3> points;
    for (int i = 0; i < 100; ++i)
      points.push_back(turn *
                       Vec3(random.normal(), random.normal() / std::sqrt(aspect), random.normal() / aspect));
    const Mvee m = fitting::mvee(points);
    CHECK(finite(m));
    CHECK(m.violation <= 1e-9);
  }
}

TEST_CASE("mvee: the build keeps NaN, without which points with NaN would not be skipped") {
  // Under -ffinite-math-only compilers remove the check that skips points with NaN; this case fails then.
  const volatile double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(std::isnan(nan));
  const double copy = nan;
  CHECK_FALSE(Vec3(0.0, copy, 0.0).allFinite());
}

TEST_CASE("mvee_first_order: the volume is that of the exact solver within epsilon") {
  engine::Random random(13);
  for (int trial = 0; trial < 200; ++trial) {
    const auto points = random_set(random);
    const Mvee exact = fitting::mvee(points), fast = fitting::mvee_first_order(points, 1e-3);
    CHECK(finite(fast));
    CHECK(fast.violation <= 1e-9);
    CHECK(fast.rank == exact.rank);
    CHECK(fast.volume_gap <= (exact.rank == 3 ? 1.1e-3 : 1.1e-3));
    if (exact.rank == 3) {
      const double ratio = geometry::volume(fast.ellipsoid) / geometry::volume(exact.ellipsoid);
      CHECK(ratio >= 1.0 - 1e-6);
      CHECK(ratio <= 1.0 + 2e-3);
    }
  }
}
