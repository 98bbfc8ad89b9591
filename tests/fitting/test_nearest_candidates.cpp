// Lists of candidates are those of brute force, in the same order, for blocks of any extent.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include <bodice/engine/random.hpp>

#include "tight/nearest_candidates.hpp"

using namespace bodice;
using fitting::FloatEllipsoid;
using fitting::NearestCandidates;
using geometry::Vec3;

namespace {

constexpr double kReach = 0.06;
constexpr double kDistanceError =
    1e-3;  // bound on the error of batch_distances(), which is largest deep inside

std::vector<geometry::Ellipsoid> scattered(engine::Random& random, int count) {
  std::vector<geometry::Ellipsoid> ellipsoids;
  for (int k = 0; k < count; ++k) {
    const auto in = [&](double low, double high) { return random.uniform(low, high); };
    const Vec3 axis = Vec3(in(-1, 1), in(-1, 1), in(-1, 1)).stableNormalized();
    ellipsoids.push_back({Vec3(in(-0.3, 0.3), in(-0.3, 0.3), in(-0.3, 0.3)),
                          Eigen::AngleAxisd(in(0, 3), axis).toRotationMatrix(),
                          Vec3(in(0.03, 0.1), in(0.03, 0.1), in(0.03, 0.1))});
  }
  return ellipsoids;
}

/// The samples of one block, at most `spread` from its center along each axis.
struct Block {
  std::vector<float> x, y, z, from_center;
  std::array<float, 3> center;
  std::array<std::vector<float>, 4> from_ball;  // distances of the center to all ellipsoids, and the normals

  Block(engine::Random& random, const std::vector<geometry::Ellipsoid>& ellipsoids, std::size_t count,
        double spread) {
    const auto in = [&](double half) { return random.uniform(-half, half); };
    for (float& c : center) c = static_cast<float>(in(0.3));
    const Vec3 middle(double{center[0]}, double{center[1]}, double{center[2]});
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3 off(in(spread), in(spread), in(spread));
      x.push_back(static_cast<float>(middle.x() + off.x()));
      y.push_back(static_cast<float>(middle.y() + off.y()));
      z.push_back(static_cast<float>(middle.z() + off.z()));
      from_center.push_back(static_cast<float>(off.norm()));
    }
    for (const auto& e : ellipsoids) {
      const auto closest = geometry::closest_point(e, middle);
      from_ball[0].push_back(static_cast<float>(closest.signed_distance));
      for (int j = 0; j < 3; ++j) from_ball[1 + j].push_back(static_cast<float>(closest.normal[j]));
    }
  }
  Vec3 point(std::size_t i) const { return {double{x[i]}, double{y[i]}, double{z[i]}}; }
  fitting::SampleBlock view() const {
    return {.count = x.size(),
            .at = {x.data(), y.data(), z.data()},
            .from_center = from_center.data(),
            .center = center,
            .from_ball = {
                from_ball[0].data(), {from_ball[1].data(), from_ball[2].data(), from_ball[3].data()}, 1}};
  }
};

}  // namespace

TEST_CASE("nearest candidates: they are those of brute force, in the same order") {
  engine::Random random(12);
  NearestCandidates found;
  std::size_t checked = 0, full = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const auto ellipsoids = scattered(random, 5 + trial);
    const std::vector<FloatEllipsoid> in_floats(ellipsoids.begin(), ellipsoids.end());
    const std::size_t count = trial % 3 == 0 ? 7 : fitting::kSampleBlock;
    const Block block(random, ellipsoids, count, trial % 2 == 0 ? 0.01 : 0.08);
    found.find(in_floats, block.view(), static_cast<float>(kReach));
    for (std::size_t i = 0; i < count; ++i) {
      std::vector<double> truth;
      for (const auto& e : ellipsoids)
        truth.push_back(geometry::closest_point(e, block.point(i)).signed_distance);
      const auto listed = found.of(i);
      const auto size = static_cast<std::size_t>(found.count(i));
      std::vector<bool> is_listed(truth.size(), false);
      for (std::size_t s = 0; s < size; ++s) {
        is_listed[listed[s]] = true;
        if (s > 0) CHECK(truth[listed[s]] > truth[listed[s - 1]] - kDistanceError);
      }
      REQUIRE(size > 0);
      const double least = *std::ranges::min_element(truth);
      CHECK(truth[listed[0]] < least + kDistanceError);
      // An ellipsoid that is not listed is beyond reach, or no nearer than the last of a full list.
      const bool is_full = size == static_cast<std::size_t>(NearestCandidates::kMost);
      const double bound = is_full ? truth[listed[size - 1]] : least + kReach;
      for (std::size_t k = 0; k < truth.size(); ++k)
        if (!is_listed[k]) CHECK(truth[k] > bound - kDistanceError);
      CHECK(truth[listed[size - 1]] < least + kReach + kDistanceError);
      full += is_full;
      ++checked;
    }
  }
  CHECK(checked > 1000);
  CHECK(full > 10);
  CHECK(full < checked / 2);
}
