#include <doctest/doctest.h>

#include <vector>

#include <bodice/engine/executor.hpp>
#include <bodice/engine/random.hpp>
#include <bodice/fitting/kmeans.hpp>
#include <bodice_test/executors.hpp>

using namespace bodice;
using fitting::Clusters;
using geometry::Vec3;

namespace {

std::vector<Vec3> random_points(int n, double scale, const Vec3& offset) {
  engine::Random random(5);
  std::vector<Vec3> points;
  for (int i = 0; i < n; ++i)
    points.push_back(offset + scale * Vec3(random.uniform(), random.uniform(), random.uniform()));
  return points;
}

}  // namespace

TEST_CASE("kmeans: an iteration assigns points and averages them as brute force does") {
  const auto points = random_points(3000, 1.0, Vec3(2, 0, -1));
  std::vector<Vec3> centers(points.begin(), points.begin() + 7);
  const Clusters found = fitting::kmeans({}, points, {}, centers, {0.0, 1});
  std::vector<Vec3> sum(centers.size(), Vec3::Zero());
  std::vector<double> count(centers.size(), 0.0);
  int different = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::size_t best = 0;
    for (std::size_t k = 1; k < centers.size(); ++k)
      if ((points[i] - centers[k]).squaredNorm() < (points[i] - centers[best]).squaredNorm()) best = k;
    different += best != found.of_point[i];
    sum[found.of_point[i]] += points[i];
    count[found.of_point[i]] += 1.0;
  }
  CHECK(different <= 1);  // comparison in float may decide one tie differently
  for (std::size_t k = 0; k < centers.size(); ++k)
    CHECK((found.centers[k] - sum[k] / count[k]).norm() < 1e-12);
}

TEST_CASE("kmeans: the pruned stop saves iterations, and a zero threshold reaches a fixed point") {
  const auto points = random_points(4000, 1.0, Vec3::Zero());
  const std::vector<Vec3> centers(points.begin(), points.begin() + 12);
  const Clusters full = fitting::kmeans({}, points, {}, centers, {0.0, 1000});
  const Clusters pruned = fitting::kmeans({}, points, {}, centers, {0.01, 1000});
  CHECK(pruned.iterations < full.iterations);
  const Clusters again = fitting::kmeans({}, points, {}, full.centers, {0.0, 1000});
  CHECK(again.of_point == full.of_point);
  CHECK(again.iterations == 1);
}

TEST_CASE("kmeans: at any scale and offset, the bits are the same for any number of workers") {
  for (const double scale : {1e-6, 1.0, 1e6}) {
    const auto points = random_points(5000, scale, Vec3(1e4, 0, 0) * scale);
    const std::vector<Vec3> centers(points.begin(), points.begin() + 9);
    const Clusters serial = fitting::kmeans({}, points, {}, centers, {1e-3 * scale, 50});
    for (const int workers : {2, 3, 7}) {
      const auto executor = bodice_test::make_threads(workers);
      engine::Context context;
      context.executor = executor.get();
      const Clusters found = fitting::kmeans(context, points, {}, centers, {1e-3 * scale, 50});
      CHECK(found.of_point == serial.of_point);
      CHECK(found.centers == serial.centers);
    }
  }
}

TEST_CASE("kmeans: no points, no centers, duplicates and a center far from all points are fine") {
  CHECK(fitting::kmeans({}, {}, {}, {Vec3::Zero()}, {}).of_point.empty());
  const std::vector<Vec3> same(10, Vec3(1, 1, 1));
  CHECK(fitting::kmeans({}, same, {}, {}, {}).of_point.size() == 10);
  const Clusters found = fitting::kmeans({}, same, {}, {Vec3(1, 1, 1), Vec3(9, 9, 9)}, {});
  for (const auto k : found.of_point) CHECK(k == 0);
  CHECK(found.centers[1] == Vec3(9, 9, 9));
}

TEST_CASE("kmeans: a center is the weighted mean of its points") {
  const std::vector<Vec3> points = {Vec3(0, 0, 0), Vec3(1, 0, 0)};
  const std::vector<double> weights = {1.0, 3.0};
  const Clusters found = fitting::kmeans({}, points, weights, {Vec3(0.5, 0, 0)}, {});
  CHECK(found.centers[0].x() == doctest::Approx(0.75));
}
