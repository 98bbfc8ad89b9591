#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>

#include <doctest/doctest.h>

#include <Eigen/Geometry>

#include <bodice/engine/random.hpp>
#include <bodice/geometry/decompositions.hpp>
#include <bodice_test/allocations.hpp>
#include <bodice_test/executors.hpp>

#include "moving_body.hpp"

using namespace bodice;
using namespace binding_test;
using geometry::Vec3;

namespace {

/// Bytes divide a table's heights, and what its slopes add, into 255 steps of 60 mm at most. Rounding may
/// change either by one step.
constexpr double kByteStep_m = 2.0 * 0.060 / 255.0;

std::vector<Vec3> points_near(const MovingBody& moving, int count) {
  const engine::Random random(3);
  std::vector<Vec3> points;
  const auto& at = moving.body.mesh.positions;
  for (std::uint64_t i = 0; points.size() < static_cast<std::size_t>(count); ++i) {
    const Vec3 shift(random.uniform_at(4 * i), random.uniform_at(4 * i + 1), random.uniform_at(4 * i + 2));
    const auto v = static_cast<std::size_t>(random.uniform_at(4 * i + 3) * static_cast<double>(at.size()));
    points.push_back(at[v] + 0.06 * (shift - Vec3::Constant(0.5)));
  }
  return points;
}

bool same_bits(const proxy::PosedProxy& a, const proxy::PosedProxy& b) {
  const auto same = [](const auto& x, const auto& y) {
    return x.size() == y.size() && std::memcmp(x.data(), y.data(), x.size() * sizeof(x[0])) == 0;
  };
  bool equal = same(a.shapes, b.shapes) && same(a.texels, b.texels) && same(a.burial, b.burial);
  for (std::size_t k = 0; k < a.relief.size(); ++k)
    equal = equal && a.relief[k].h_offset_m == b.relief[k].h_offset_m &&
            a.relief[k].h_scale_m == b.relief[k].h_scale_m && a.relief[k].a_scale == b.relief[k].a_scale;
  return equal;
}

JointMatrix motion(double degrees, const Vec3& axis, const Vec3& shift, double scale = 1.0) {
  return rig::affine(
      scale * Eigen::AngleAxisd(degrees / 180.0 * std::numbers::pi, axis.normalized()).toRotationMatrix(),
      shift);
}

}  // namespace

TEST_CASE(
    "in the bind pose the posed proxy is the proxy at rest, to the step of a table's bytes at 98 of 100 "
    "points, "
    "and to a twentieth of a millimeter on average") {
  const MovingBody& moving = moving_body();
  binding::Poser poser = make_poser(moving);
  REQUIRE(poser.pose({}, bind_pose(moving.body.skeleton)));
  double sum_m = 0.0;
  int off = 0;
  const std::vector<Vec3> points = points_near(moving, 1000);
  for (const Vec3& point : points) {
    const double rest = proxy::proxy_distance(moving.bound, point).distance;
    const double posed = proxy::posed_proxy_distance(moving.bound, poser.posed(), point).distance;
    sum_m += std::abs(posed - rest);
    off += std::abs(posed - rest) > kByteStep_m;
  }
  CAPTURE(off);
  CHECK(off <= 20);  // where burial is interpolated between a texel that is buried and one that is not
  CHECK(sum_m / 1000.0 < 5e-5);
}

TEST_CASE("a rigid motion of all joints moves the distance with it, also 10 km away") {
  const MovingBody& moving = moving_body();
  binding::Poser poser = make_poser(moving), there = make_poser(moving);
  const Pose pose = march(moving.body.skeleton);
  REQUIRE(poser.pose({}, pose));
  for (const double far_m : {1.0, 1e4}) {
    const JointMatrix map = motion(70.0, {1.0, 2.0, -1.0}, far_m * Vec3(0.6, 0.0, 0.8));
    REQUIRE(there.pose({}, moved(map, pose)));
    for (const Vec3& point : points_near(moving, 200)) {
      const auto here = proxy::posed_proxy_distance(moving.bound, poser.posed(), point);
      const auto away = proxy::posed_proxy_distance(moving.bound, there.posed(), rig::apply(map, point));
      CHECK(std::abs(away.distance - here.distance) < kByteStep_m);
    }
  }
}

TEST_CASE("a uniform scale of all joints scales the distance, from a millionth to a million") {
  const MovingBody& moving = moving_body();
  binding::Poser poser = make_poser(moving), there = make_poser(moving);
  const Pose pose = march(moving.body.skeleton);
  REQUIRE(poser.pose({}, pose));
  for (const double scale : {1e-6, 0.5, 2.0, 1e6}) {
    CAPTURE(scale);
    const JointMatrix map = motion(20.0, {0.0, 1.0, 0.0}, Vec3::Zero(), scale);
    REQUIRE(there.pose({}, moved(map, pose)));
    CHECK(there.posed().scale == doctest::Approx(scale));
    for (const Vec3& point : points_near(moving, 100)) {
      const auto here = proxy::posed_proxy_distance(moving.bound, poser.posed(), point);
      const auto away = proxy::posed_proxy_distance(moving.bound, there.posed(), rig::apply(map, point));
      CHECK(std::abs(away.distance / scale - here.distance) < kByteStep_m);
    }
  }
}

TEST_CASE("a pose has the same bits for any executor") {
  const MovingBody& moving = moving_body();
  const Pose pose = seat(moving.body.skeleton);
  binding::Poser first = make_poser(moving);
  REQUIRE(first.pose({}, pose));
  for (const auto& [name, executor] : bodice_test::all_executors()) {
    CAPTURE(name);
    binding::Poser poser = make_poser(moving);
    REQUIRE(poser.pose({.executor = executor.get()}, pose));
    CHECK(same_bits(poser.posed(), first.posed()));
  }
}

TEST_CASE("a pose does not depend on the poses before it") {
  const MovingBody& moving = moving_body();
  binding::Poser direct = make_poser(moving), roundabout = make_poser(moving);
  const Pose pose = march(moving.body.skeleton);
  REQUIRE(direct.pose({}, pose));
  REQUIRE(roundabout.pose({}, seat(moving.body.skeleton)));
  REQUIRE(roundabout.pose({}, seat(moving.body.skeleton), {.tables = false}));
  REQUIRE(roundabout.pose({}, pose));
  CHECK(same_bits(roundabout.posed(), direct.posed()));
}

TEST_CASE("the pose before the last one stays readable as it was") {
  const MovingBody& moving = moving_body();
  binding::Poser poser = make_poser(moving);
  REQUIRE(poser.pose({}, march(moving.body.skeleton)));
  const proxy::PosedProxy kept = poser.posed();
  REQUIRE(poser.pose({}, seat(moving.body.skeleton)));
  CHECK(same_bits(poser.previous(), kept));
  CHECK_FALSE(same_bits(poser.posed(), kept));
  CHECK(poser.poses() == 2);
}

TEST_CASE("warm poses allocate nothing") {
  if (!bodice_test::counts_allocations()) return;
  const MovingBody& moving = moving_body();
  binding::Poser poser = make_poser(moving);
  const Pose pose = march(moving.body.skeleton);
  const geometry::Box box{Vec3::Zero(), Vec3::Ones()};
  CHECK(bodice_test::allocations_when_warm(4, [&] { (void)poser.pose({}, pose); }) == 0);
  CHECK(bodice_test::allocations_when_warm(
            4, [&] { (void)poser.pose({}, pose, {.tables = true, .within = std::span(&box, 1)}); }) == 0);
}

TEST_CASE("a joint's matrix that is no rotation with a scale is refused by name, and nothing moves") {
  const MovingBody& moving = moving_body();
  binding::Poser poser = make_poser(moving);
  const Pose pose = march(moving.body.skeleton);
  REQUIRE(poser.pose({}, pose));
  const proxy::PosedProxy before = poser.posed();
  const auto joint = *rig::find_joint(moving.body.skeleton, "calf_l");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  struct Case {
    JointMatrix factor;
    const char* reason;
  };
  JointMatrix shear = rig::identity(), mirror = rig::identity(), flat = rig::identity(),
              zero = rig::identity(), not_finite = rig::identity(), stretched = rig::identity();
  shear(0, 1) = 0.05;
  mirror(0, 0) = -1.0;
  flat(2, 2) = 1e-30;
  zero.setZero();
  not_finite(1, 3) = nan;
  stretched(1, 1) = 1.1;
  for (const auto& [factor, reason] :
       {Case{shear, "shears"}, Case{mirror, "mirrors"}, Case{flat, "flat"}, Case{zero, "no extent"},
        Case{not_finite, "not finite"}, Case{stretched, "unlike"},
        Case{motion(0.0, Vec3::UnitX(), Vec3::Zero(), 1e7), "million"}}) {
    CAPTURE(reason);
    Pose bad = pose;
    bad[joint] = rig::compose(factor, bad[joint]);
    const auto result = poser.pose({}, bad);
    REQUIRE_FALSE(result);
    CHECK(result.error().code == engine::ErrorCode::kInvalidArgument);
    CHECK(result.error().message.find("'calf_l'") != std::string::npos);
    CHECK(result.error().message.find(reason) != std::string::npos);
    CHECK(same_bits(poser.posed(), before));
  }
  CHECK_FALSE(poser.pose({}, std::span(pose).first(3)));
}

TEST_CASE("products of twenty float matrices are taken in every frame") {
  const MovingBody& moving = moving_body();
  binding::Poser poser = make_poser(moving);
  const engine::Random random(9);
  std::uint64_t draw = 0;
  for (int frame = 0; frame < 20; ++frame) {
    std::vector<float> floats;
    for (const rig::Joint& joint : moving.body.skeleton.joints) {
      Eigen::Matrix4f chain = Eigen::Matrix4f::Identity();
      for (int link = 0; link < 20; ++link) {
        const Vec3 axis(random.uniform_at(draw), random.uniform_at(draw + 1), random.uniform_at(draw + 2));
        const auto half = static_cast<float>(3.0 * random.uniform_at(draw + 3));
        draw += 4;
        // A quaternion in floats, not normalized again, as engines multiply them.
        const Eigen::Vector3f v = std::sin(half) * axis.normalized().cast<float>();
        const Eigen::Quaternionf q(std::cos(half), v.x(), v.y(), v.z());
        Eigen::Matrix4f step = Eigen::Matrix4f::Identity();
        step.topLeftCorner<3, 3>() = q.toRotationMatrix();
        chain = chain * step;
      }
      Eigen::Matrix4f bind = Eigen::Matrix4f::Identity();
      bind.topRows<3>() = joint.bind.cast<float>();
      const Eigen::Matrix4f world = chain * bind;
      for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column) floats.push_back(world(row, column));
    }
    CHECK(poser.pose({}, floats, 12));
  }
}

TEST_CASE("an entry that is off by a thousandth is mended; a bone that turns by 180 degrees is finite") {
  const MovingBody& moving = moving_body();
  binding::Poser poser = make_poser(moving);
  Pose pose = bind_pose(moving.body.skeleton);
  const auto joint = *rig::find_joint(moving.body.skeleton, "forearm_r");
  pose[joint](0, 1) += 1e-3;
  CHECK(poser.pose({}, pose));
  const Pose twisted = turned(moving.body.skeleton, {{"forearm_r", {Vec3::UnitX(), 180.0}},
                                                     {"calf_l", {Vec3::UnitX(), 180.0}},
                                                     {"neck", {Vec3::UnitY(), 180.0}}});
  REQUIRE(poser.pose({}, twisted));
  for (const geometry::Ellipsoid& e : poser.posed().shapes) {
    CHECK(e.center.allFinite());
    CHECK(e.radii.minCoeff() > 0.0);
    CHECK((e.axes.transpose() * e.axes - geometry::Mat3::Identity()).norm() < 1e-9);
  }
  for (const Vec3& point : points_near(moving, 50))
    CHECK(std::isfinite(proxy::posed_proxy_distance(moving.bound, poser.posed(), point).distance));
}

TEST_CASE("arms and legs that turn by any angle fold no ellipsoid and turn none inside out") {
  const MovingBody& moving = moving_body();
  binding::Poser poser = make_poser(moving);
  for (double degrees = 20.0; degrees <= 180.0; degrees += 20.0) {
    REQUIRE(poser.pose({}, turned(moving.body.skeleton, {{"upper_arm_l", {Vec3::UnitZ(), degrees}},
                                                         {"upper_arm_r", {Vec3::UnitZ(), -degrees}},
                                                         {"thigh_l", {Vec3::UnitX(), -degrees}},
                                                         {"thigh_r", {Vec3::UnitX(), -degrees}}})));
    for (std::size_t k = 0; k < moving.bound.ellipsoids().size(); ++k) {
      const geometry::Ellipsoid& rest = moving.bound.ellipsoids()[k].shape;
      const geometry::Mat3 map =
          poser.posed().material[k] * rest.radii.cwiseInverse().asDiagonal() * rest.axes.transpose();
      CAPTURE(k);
      CHECK(map.determinant() > 0.0);
      CHECK(geometry::singular_values(map).values.minCoeff() > 0.4);
    }
  }
}

TEST_CASE("a proxy without a binding cannot be posed") {
  proxy::BodyProxy::Data data = moving_body().bound.data();
  data.binding = nullptr;
  for (proxy::ProxyEllipsoid& e : data.ellipsoids) e.bone = proxy::kNoBone;
  const auto unbound = proxy::BodyProxy::make(std::move(data));
  REQUIRE(unbound);
  const auto poser = binding::Poser::make(*unbound);
  REQUIRE_FALSE(poser);
  CHECK(poser.error().message == "Pose: the proxy is not bound to joints.");
}
