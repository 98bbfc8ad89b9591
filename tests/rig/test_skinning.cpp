#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <numbers>

#include <bodice/rig/rig.hpp>
#include <bodice_test/allocations.hpp>
#include <bodice_test/executors.hpp>

#include "chains.hpp"
#include "random_rig.hpp"

using namespace bodice::rig;
using namespace rig_test;
using bodice::engine::Random;

// Programs for processors with AVX, where Eigen aligns by more, share these types with libraries without it.
static_assert(alignof(Affine) == alignof(double) && alignof(LocalTransform) == alignof(double) &&
              alignof(DualQuaternion) == alignof(double));

namespace {

std::vector<Vec3> linear(const std::vector<Vec3>& rest, const SkinWeights& weights,
                         const std::vector<Affine>& skinning) {
  std::vector<Vec3> posed(rest.size());
  skin_linear(rest, weights, skinning, posed);
  return posed;
}

std::vector<Vec3> dual(const std::vector<Vec3>& rest, const SkinWeights& weights,
                       const std::vector<Affine>& skinning) {
  std::vector<DualQuaternion> motion(skinning.size());
  dual_quaternions(skinning, motion);
  std::vector<Vec3> posed(rest.size());
  skin_dual_quaternion(rest, weights, motion, posed);
  return posed;
}

double farthest(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double worst = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, (a[i] - b[i]).norm());
  return worst;
}

std::vector<Vec3> mapped(const std::vector<Vec3>& points, const Affine& map) {
  std::vector<Vec3> result;
  for (const Vec3& p : points) result.push_back(apply(map, p));
  return result;
}

}  // namespace

TEST_CASE("skinning: of two joints, the second bent by 90 degrees, points land where a hand computes") {
  const Rig rig = arm();
  std::vector<Affine> world(2), skinning(2);
  joint_matrices(rig.skeleton, elbow_bent_90(), 1.0, world);
  skinning_matrices(rig.skeleton, world, skinning);
  const std::vector<Vec3> rest = {{0.5, 0, 0}, {1.5, 0, 0}, {1.0, 0.1, 0}};
  const std::vector<Vec3> posed = linear(rest, rig.weights, skinning);
  CHECK((posed[0] - Vec3(0.5, 0, 0)).norm() < 1e-12);  // the upper arm stays
  CHECK((posed[1] - Vec3(1, 0.5, 0)).norm() < 1e-12);  // the forearm points up
  // Half of each joint: the mean of (1, .1, 0) and the elbow's (1 - .1, 0, 0).
  CHECK((posed[2] - Vec3(0.95, 0.05, 0)).norm() < 1e-12);
  // As a dual quaternion the half turns by 45 degrees about the elbow: no length is lost.
  const double half = 0.1 * std::sqrt(0.5);
  CHECK((dual(rest, rig.weights, skinning)[2] - Vec3(1.0 - half, half, 0)).norm() < 1e-12);
}

TEST_CASE("skinning: the sum over all joints, term by term, is what linear blending gives") {
  Random random(1);
  const auto rest = random_points(500, random);
  const SkinWeights weights = random_weights(500, 20, random);
  std::vector<Affine> skinning(20);
  for (Affine& map : skinning) map = affine(Mat3::Random(), random_vec3(random));
  const auto posed = linear(rest, weights, skinning);
  for (std::size_t v = 0; v < rest.size(); ++v) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t e = weights.first[v]; e < weights.first[v + 1]; ++e)
      sum += static_cast<double>(weights.weight[e]) * apply(skinning[weights.joint[e]], rest[v]);
    CHECK((posed[v] - sum).norm() < 1e-6);  // sums of float weights are off by 1e-7
    CHECK((apply(blended_matrix(weights, v, skinning), rest[v]) - posed[v]).norm() == 0.0);
  }
}

TEST_CASE(
    "skinning: where every joint moves alike the skin moves so, by linear blending for any affine map and by "
    "dual quaternions too, 10 km from the origin and with scales of 1e-6 and 1e6") {
  Random random(2);
  const auto rest = random_points(300, random);
  const SkinWeights weights = random_weights(300, 8, random);
  for (const double scale : {1.0, 1e-6, 1e6})
    for (const double away_m : {0.0, 1e4})
      for (const bool mirrored : {false, true}) {
        Mat3 linear_part = scale * random_turn(random).toRotationMatrix();
        linear_part.col(1) *= 1.7;
        linear_part.col(2) += 0.3 * linear_part.col(0);
        if (mirrored) linear_part.col(0) = -linear_part.col(0);
        const Affine map = affine(linear_part, Vec3(away_m, -away_m, 0.3));
        const std::vector<Affine> skinning(8, map);
        const auto expected = mapped(rest, map);
        CHECK(farthest(linear(rest, weights, skinning), expected) < 1e-12 * (away_m + 0.3 + scale));
        CHECK(farthest(dual(rest, weights, skinning), expected) < 1e-11 * (away_m + 0.3 + scale));
      }
}

TEST_CASE("skinning: a motion of the whole world moves the posed skin alike") {
  Random random(3);
  const auto rest = random_points(300, random);
  const SkinWeights weights = random_weights(300, 10, random);
  std::vector<Affine> skinning(10), moved(10);
  const Affine world = rigid(random);
  for (std::size_t j = 0; j < 10; ++j) {
    skinning[j] = rigid(random);
    moved[j] = compose(world, skinning[j]);
  }
  CHECK(farthest(linear(rest, weights, moved), mapped(linear(rest, weights, skinning), world)) < 1e-12);
  CHECK(farthest(dual(rest, weights, moved), mapped(dual(rest, weights, skinning), world)) < 1e-11);
}

TEST_CASE("dual quaternion skinning: a half twist keeps the radius, which linear blending loses") {
  Rig rig = arm();
  rig.weights = {{0, 2}, {0, 1}, {0.5f, 0.5f}};
  Affine twist = identity();
  twist.leftCols<3>() = Eigen::AngleAxisd(0.9 * std::numbers::pi, Vec3::UnitX()).toRotationMatrix();
  const std::vector<Affine> skinning = {identity(), twist};
  const std::vector<Vec3> rest = {{1.0, 0.1, 0.0}};
  CHECK(dual(rest, rig.weights, skinning)[0].tail<2>().norm() == doctest::Approx(0.1).epsilon(1e-12));
  CHECK(linear(rest, rig.weights, skinning)[0].tail<2>().norm() < 0.02);
}

TEST_CASE(
    "dual quaternion skinning: a rigid joint alone moves its vertices rigidly, the signs of others aside") {
  Random random(4);
  const auto rest = random_points(50, random);
  SkinWeights weights;
  weights.first = {0};
  for (std::size_t v = 0; v < 50; ++v) {
    weights.joint.push_back(static_cast<std::uint16_t>(v % 3));
    weights.weight.push_back(1.0f);
    weights.first.push_back(static_cast<std::uint32_t>(v + 1));
  }
  const std::vector<Affine> skinning = {rigid(random), rigid(random), rigid(random)};
  CHECK(farthest(dual(rest, weights, skinning), linear(rest, weights, skinning)) < 1e-12);
}

TEST_CASE("skinning: singular matrices and those that are not finite spoil no vertex of other joints") {
  Rig rig = arm();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Vec3> rest = {{0.5, 0, 0}, {1.5, 0, 0}, {1, 0.1, 0}};
  std::vector<Affine> skinning = {identity(), Affine::Zero()};
  for (const Vec3& p : dual(rest, rig.weights, skinning)) CHECK(p.allFinite());
  CHECK(dual(rest, rig.weights, skinning)[1].norm() == 0.0);
  skinning[1](1, 1) = nan;
  CHECK(linear(rest, rig.weights, skinning)[0] == rest[0]);
  CHECK((dual(rest, rig.weights, skinning)[0] - rest[0]).norm() < 1e-15);
  CHECK(!dual(rest, rig.weights, skinning)[1].allFinite());
}

TEST_CASE("skinning: rates of matrices give the velocities that differences of positions have") {
  Random random(6);
  const auto rest = random_points(100, random);
  const SkinWeights weights = random_weights(100, 5, random);
  std::vector<Affine> before(5), after(5), rates(5);
  for (std::size_t j = 0; j < 5; ++j) before[j] = rigid(random), after[j] = rigid(random);
  skinning_rates(before, after, 0.02, rates);
  const auto velocity = linear(rest, weights, rates), a = linear(rest, weights, before),
             b = linear(rest, weights, after);
  for (std::size_t v = 0; v < rest.size(); ++v) CHECK((velocity[v] - (b[v] - a[v]) / 0.02).norm() < 1e-9);
  skinning_rates(before, after, 0.0, rates);
  CHECK(farthest(linear(rest, weights, rates), std::vector<Vec3>(100, Vec3::Zero())) == 0.0);
}

TEST_CASE("skinning: the same bits for every executor, and no allocation once warm") {
  Random random(7);
  const auto rest = random_points(20000, random);
  const SkinWeights weights = random_weights(20000, 30, random);
  std::vector<Affine> skinning(30);
  for (Affine& map : skinning) map = rigid(random);
  std::vector<DualQuaternion> motion(30);
  dual_quaternions(skinning, motion);
  const auto expected = linear(rest, weights, skinning), expected_dual = dual(rest, weights, skinning);
  std::vector<Vec3> posed(rest.size());
  for (const auto& [name, executor] : bodice_test::all_executors()) {
    CAPTURE(name);
    const bodice::engine::Context context{.executor = executor.get()};
    skin_linear(context, rest, weights, skinning, posed);
    CHECK(posed == expected);
    skin_dual_quaternion(context, rest, weights, motion, posed);
    CHECK(posed == expected_dual);
  }
  if (!bodice_test::counts_allocations()) return;
  const Rig rig = arm();
  const Clip clip = elbow_bent_90();
  std::vector<Affine> world(2), two(2);
  const bodice::engine::Context alone;
  CHECK(bodice_test::allocations_when_warm(3, [&] {
          joint_matrices(rig.skeleton, clip, 0.4, world);
          skinning_matrices(rig.skeleton, world, two);
          dual_quaternions(skinning, motion);
          skin_linear(alone, rest, weights, skinning, posed);
          skin_dual_quaternion(alone, rest, weights, motion, posed);
        }) == 0);
}
