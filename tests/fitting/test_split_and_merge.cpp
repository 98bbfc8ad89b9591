// Split-and-merge moves are made where they pay, and a trial predicts the cost after its move.
#include <doctest/doctest.h>

#include <bodice/engine/random.hpp>

#include "shapes.hpp"
#include "tight/split_and_merge.hpp"

using namespace bodice;
using fitting::LeastSquaresProblem;
using geometry::Ellipsoid;
using geometry::Vec3;

namespace {

constexpr double kMotion = 0.012;

Ellipsoid ball(double x, double y, double radius) {
  return {Vec3(x, y, 0.0), geometry::Mat3::Identity(), Vec3::Constant(radius)};
}

/// A ball apart from the others, and two balls that overlap.
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

/// The least-squares problem of these samples, for a body of 1.7 m around the origin.
struct Setting {
  std::vector<fitting::DistanceSample> samples = samples_of_truth();
  fitting::RobustLoss loss;
  fitting::Scaling scaling;
  LeastSquaresProblem problem;

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

TEST_CASE("split and merge: a second ellipsoid of one ball moves to two balls that share one ellipsoid") {
  Setting setting;
  const Ellipsoid lower{Vec3(-0.4, 0.8, 0.0), geometry::Mat3::Identity(), Vec3(0.1, 0.06, 0.1)};
  const Ellipsoid upper{Vec3(-0.4, 0.9, 0.0), geometry::Mat3::Identity(), Vec3(0.1, 0.06, 0.1)};
  const Ellipsoid across{Vec3(0.3, 0.79, 0.0), geometry::Mat3::Identity(), Vec3(0.1, 0.19, 0.1)};
  std::vector<Ellipsoid> ellipsoids = {lower, across, upper};
  const double before = setting.cost(ellipsoids);
  setting.problem.refresh({}, ellipsoids);
  CHECK(setting.problem.total() == doctest::Approx(before).epsilon(0.01));
  CHECK(fitting::split_and_merge({}, setting.problem, ellipsoids).size() == 3);
  CHECK(setting.cost(ellipsoids) < 0.02 * before);
}

TEST_CASE("split and merge: no ellipsoid moves where each fits one ball") {
  Setting setting;
  std::vector<Ellipsoid> ellipsoids = kTruth;
  setting.problem.refresh({}, ellipsoids);
  CHECK(fitting::split_and_merge({}, setting.problem, ellipsoids).empty());
  CHECK(ellipsoids[1].center == kTruth[1].center);
}

TEST_CASE("local fit: the predicted rise of the cost is the true one") {
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

TEST_CASE("frequent neighbors: the same as counting every pair, ties by index, none beyond the ellipsoids") {
  engine::Random random(9);
  for (const std::uint32_t count : {1u, 2u, 7u, 60u}) {
    std::vector<fitting::Nearest3> ranked(2000);
    for (auto& r : ranked) {  // up to count itself, which stands for none
      const auto first = static_cast<std::uint32_t>(random.below(count));
      r = {{first, static_cast<std::uint32_t>(random.below(count + 1)), count}, {0.0f, 0.0f, 0.0f}};
    }
    std::vector<std::vector<int>> pairs(count, std::vector<int>(count, 0));
    for (const auto& r : ranked)
      if (r.ellipsoid[1] < count) ++pairs[r.ellipsoid[0]][r.ellipsoid[1]];
    const auto found = fitting::frequent_neighbors(ranked, count);
    REQUIRE(found.size() == count);
    for (std::uint32_t k = 0; k < count; ++k) {
      std::vector<std::uint32_t> expected;
      for (std::uint32_t rank = 0; rank < 3; ++rank) {
        std::uint32_t best = count;
        for (std::uint32_t j = 0; j < count; ++j)
          if (pairs[k][j] > 0 && std::ranges::find(expected, j) == expected.end() &&
              (best == count || pairs[k][j] > pairs[k][best]))
            best = j;
        if (best < count) expected.push_back(best);
      }
      CHECK(found[k] == expected);
    }
  }
}

TEST_CASE("frequent neighbors: memory grows with the samples, not with the pairs of ellipsoids") {
  constexpr std::uint32_t kMany = 1'000'000;  // a count for every pair would take terabytes
  const std::vector<fitting::Nearest3> ranked = {{{5, kMany - 1, 3}, {}}, {{5, 7, 3}, {}}, {{5, 7, 3}, {}}};
  const auto found = fitting::frequent_neighbors(ranked, kMany);
  CHECK(found[5] == std::vector<std::uint32_t>{7, kMany - 1});
  CHECK(found[4].empty());
}
