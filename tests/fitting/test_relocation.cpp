// Moves of ellipsoids: made where they pay, as foretold by the trials, and nowhere else.
#include <doctest/doctest.h>

#include <bodice/engine/random.hpp>

#include "shapes.hpp"
#include "tight/split_and_merge.hpp"

using namespace bodice;
using fitting::TightProblem;
using geometry::Ellipsoid;
using geometry::Vec3;

namespace {

constexpr double kMotion = 0.012;

Ellipsoid ball(double x, double y, double radius) {
  return {Vec3(x, y, 0.0), geometry::Mat3::Identity(), Vec3::Constant(radius)};
}

/// A ball by itself, and two that overlap.
const std::vector<Ellipsoid> kTruth = {ball(-0.4, 0.85, 0.1), ball(0.3, 0.7, 0.1), ball(0.3, 0.88, 0.1)};

double union_distance(const std::vector<Ellipsoid>& ellipsoids, const Vec3& point) {
  double least = 1e300;
  for (const Ellipsoid& e : ellipsoids)
    least = std::min(least, geometry::closest_point(e, point).signed_distance);
  return least;
}

/// Points within 20 mm of the truth's surfaces.
std::vector<fitting::DistanceSample> samples_of_truth() {
  std::vector<fitting::DistanceSample> samples;
  engine::Random random(5);
  for (const Ellipsoid& e : kTruth)
    for (int i = 0; i < 400; ++i) {
      Vec3 u(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
      const Vec3 p = e.center + (e.radii[0] + random.uniform(-0.02, 0.02)) * u.normalized();
      samples.push_back({p, union_distance(kTruth, p)});
    }
  return samples;
}

/// The problem of these samples, 1.7 m to a stature, about the origin.
struct Setting {
  std::vector<fitting::DistanceSample> samples = samples_of_truth();
  fitting::TightLoss loss;
  fitting::Scaling scaling;
  TightProblem problem;

  Setting() : scaling(skin_of_one()), problem(samples, scaling, loss, kMotion) {}

  static fitting::LabeledSkin skin_of_one() {
    static const fitting_test::Skin skin = [] {
      fitting_test::Skin made;
      made.stature_m = 1.7;
      fitting_test::add_ellipsoid(made, ball(0.0, 0.0, 1.0), body::Part::kHead, 8);
      return made;
    }();
    return skin.view();
  }

  double cost(const std::vector<Ellipsoid>& ellipsoids) const {
    double sum = 0.0;
    for (const auto& s : samples)
      sum += static_cast<double>(loss.cost(static_cast<float>(s.signed_distance_m), s.one_sided,
                                           static_cast<float>(union_distance(ellipsoids, s.point))));
    return sum;
  }
};

}  // namespace

TEST_CASE("relocation: the half of a ball that is not needed goes to two balls that have one ellipsoid") {
  Setting setting;
  const Ellipsoid lower{Vec3(-0.4, 0.8, 0.0), geometry::Mat3::Identity(), Vec3(0.1, 0.06, 0.1)};
  const Ellipsoid upper{Vec3(-0.4, 0.9, 0.0), geometry::Mat3::Identity(), Vec3(0.1, 0.06, 0.1)};
  const Ellipsoid across{Vec3(0.3, 0.79, 0.0), geometry::Mat3::Identity(), Vec3(0.1, 0.19, 0.1)};
  std::vector<Ellipsoid> ellipsoids = {lower, across, upper};
  const double before = setting.cost(ellipsoids);
  setting.problem.refresh({}, ellipsoids);
  CHECK(setting.problem.total() == doctest::Approx(before).epsilon(0.01));
  CHECK(fitting::relocate({}, setting.problem, ellipsoids).size() == 3);
  CHECK(setting.cost(ellipsoids) < 0.02 * before);
}

TEST_CASE("relocation: nothing moves where every ellipsoid is where it belongs") {
  Setting setting;
  std::vector<Ellipsoid> ellipsoids = kTruth;
  setting.problem.refresh({}, ellipsoids);
  CHECK(fitting::relocate({}, setting.problem, ellipsoids).empty());
  CHECK(ellipsoids[1].center == kTruth[1].center);
}

TEST_CASE("local fit: what it says the cost rises by is what it rises by") {
  Setting setting;
  std::vector<Ellipsoid> ellipsoids = kTruth;
  ellipsoids[1].center.x() += 0.01;
  ellipsoids[2].radii *= 1.05;
  setting.problem.refresh({}, ellipsoids);
  const double before = setting.cost(ellipsoids);
  const std::uint32_t both[] = {1, 2};
  const fitting::Neighborhood samples = setting.problem.around(both, setting.problem.rank({}));
  CHECK(samples.x.size() == 800);
  CHECK(samples.cost == doctest::Approx(before).epsilon(0.01));
  fitting::LocalFit fit(samples, setting.loss, {ellipsoids[1], ellipsoids[2]});
  CHECK(fit.rise() == doctest::Approx(0.0).epsilon(0.01 * before));
  fit.advance(6);
  const auto& found = fit.ellipsoids();
  const double rise = setting.cost({ellipsoids[0], found[0], found[1]}) - before;
  CHECK(fit.rise() == doctest::Approx(rise).epsilon(0.01));
  CHECK(fit.rise() < -0.95 * before);
}
