// The collider on a posed proxy, against the scalar double reference.
#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include <bodice/collision/collider.hpp>
#include <bodice/engine/random.hpp>
#include <bodice_test/allocations.hpp>

#include "moving_body.hpp"

using namespace bodice;
using namespace binding_test;
using geometry::Vec3;

namespace {

std::vector<Vec3> points_near(const geometry::TriMesh& skin, int count) {
  const engine::Random random(11);
  std::vector<Vec3> points;
  for (std::uint64_t i = 0; points.size() < static_cast<std::size_t>(count); i += 4) {
    const auto v =
        static_cast<std::size_t>(random.uniform_at(i) * static_cast<double>(skin.positions.size()));
    const Vec3 shift(random.uniform_at(i + 1), random.uniform_at(i + 2), random.uniform_at(i + 3));
    points.push_back(skin.positions[v] + 0.06 * (shift - Vec3::Constant(0.5)));
  }
  return points;
}

}  // namespace

TEST_CASE("a collider in a pose has the distances of the scalar reference, with and without a limit") {
  const MovingBody& moving = moving_body();
  binding::Poser poser = make_poser(moving);
  collision::Collider collider(moving.bound);
  for (const Pose& pose : {march(moving.body.skeleton), seat(moving.body.skeleton)}) {
    REQUIRE(poser.pose({}, pose));
    REQUIRE(collider.pose(poser.posed(), 1.0 / 60.0));
    for (const Vec3& point : points_near(posed_skin(moving, pose), 300)) {
      const proxy::ProxyDistance truth = proxy::posed_proxy_distance(moving.bound, poser.posed(), point);
      const Eigen::Vector3f local = (point - collider.origin()).cast<float>();
      const auto contact = collider.query({local.x(), local.y(), local.z()});
      CHECK(std::abs(double{contact.signed_distance} - truth.distance) < 2e-5);
      const auto within = collider.query({local.x(), local.y(), local.z()}, {.within_m = 0.005f});
      if (truth.distance < 0.0049) CHECK(within.signed_distance == contact.signed_distance);
      if (truth.distance > 0.0051) CHECK(within.ellipsoid == collision::kNoEllipsoid);
    }
  }
}

TEST_CASE("contacts in a pose know the velocity of the limb that moved") {
  const MovingBody& moving = moving_body();
  binding::Poser poser = make_poser(moving);
  collision::Collider collider(moving.bound);
  const Pose pose = bind_pose(moving.body.skeleton);
  REQUIRE(poser.pose({}, pose));
  REQUIRE(collider.pose(poser.posed(), 0.0));
  const JointMatrix step = rig::affine(geometry::Mat3::Identity(), Vec3(0.01, 0.0, 0.0));
  REQUIRE(poser.pose({}, moved(step, pose)));
  REQUIRE(collider.pose(poser.posed(), 0.01));
  for (std::uint32_t k = 0; k < collider.size(); ++k) {
    const Vec3 at = poser.posed().shapes[k].center - collider.origin();
    CHECK((collider.surface_velocity(k, at) - Vec3(1.0, 0.0, 0.0)).norm() < 1e-3);
  }
}

TEST_CASE("a pose of another proxy is refused, and a warm pose allocates nothing") {
  const MovingBody& moving = moving_body();
  binding::Poser poser = make_poser(moving);
  collision::Collider collider(moving.bound);
  REQUIRE(poser.pose({}, march(moving.body.skeleton)));
  proxy::PosedProxy fewer = poser.posed();
  fewer.texels.pop_back();
  CHECK_FALSE(collider.pose(fewer, 0.01));
  fewer = poser.posed();
  fewer.shapes.pop_back();
  CHECK_FALSE(collider.pose(fewer, 0.01));
  if (!bodice_test::counts_allocations()) return;
  CHECK(bodice_test::allocations_when_warm(4, [&] { (void)collider.pose(poser.posed(), 0.01); }) == 0);
}

TEST_CASE("the surface of a posed collider moves as the skin does, also where axes swap") {
  const MovingBody& moving = moving_body();
  binding::Poser poser = make_poser(moving);
  collision::Collider collider(moving.bound);
  const double dt_s = 1.0 / 60.0;
  geometry::TriMesh before;
  double error_m_s = 0.0, speed_m_s = 0.0, worst_m_s = 0.0, fastest_m_s = 0.0;
  for (int frame = 0; frame <= 12; ++frame) {
    const double degrees = 5.0 * frame;
    const Pose pose = turned(moving.body.skeleton, {{"thigh_l", {Vec3::UnitX(), -degrees}},
                                                    {"calf_l", {Vec3::UnitX(), 1.4 * degrees}},
                                                    {"upper_arm_r", {Vec3::UnitZ(), -degrees}}});
    REQUIRE(poser.pose({}, pose));
    REQUIRE(collider.pose(poser.posed(), dt_s));
    const geometry::TriMesh skin = posed_skin(moving, pose);
    for (std::size_t v = 0; frame > 0 && v < skin.positions.size(); v += 7) {
      const Vec3 truth = (skin.positions[v] - before.positions[v]) / dt_s;
      const Vec3 local = skin.positions[v] - collider.origin();
      const Eigen::Vector3f p = local.cast<float>();
      const collision::Contact contact = collider.query({p.x(), p.y(), p.z()});
      const Vec3 found = collider.surface_velocity(contact.ellipsoid, local);
      error_m_s += (found - truth).norm();
      speed_m_s += truth.norm();
      worst_m_s = std::max(worst_m_s, (found - truth).norm());
      fastest_m_s = std::max(fastest_m_s, truth.norm());
    }
    before = skin;
  }
  CAPTURE(worst_m_s);
  CAPTURE(fastest_m_s);
  CHECK(error_m_s < 0.15 * speed_m_s);
  CHECK(worst_m_s < fastest_m_s);
}

TEST_CASE("a posed collider that covers the skin is nowhere below it, and the next pose takes that back") {
  const MovingBody& moving = moving_body();
  binding::Poser poser = make_poser(moving);
  collision::Collider collider(moving.bound), without(moving.bound);
  constexpr float kTolerance_m = 0.7e-3f, kRounding_m = 0.1e-3f;
  for (const Pose& pose :
       {march(moving.body.skeleton), seat(moving.body.skeleton), squat(moving.body.skeleton)}) {
    REQUIRE(poser.pose({}, pose));
    REQUIRE(collider.pose(poser.posed(), 0.0));
    REQUIRE(without.pose(poser.posed(), 0.0));
    const std::vector<Vec3> skin = posed_skin(moving, pose).positions;
    const auto distance_m = [&](const collision::Collider& of, const Vec3& point) {
      const Eigen::Vector3f local = (point - of.origin()).cast<float>();
      return of.query({local.x(), local.y(), local.z()}).signed_distance;
    };
    const auto count_below = [&](float by_m) {
      return std::ranges::count_if(skin, [&](const Vec3& v) { return distance_m(collider, v) > by_m; });
    };
    const auto below = count_below(kTolerance_m);
    CHECK(static_cast<std::size_t>(below) > skin.size() / 50);
    const auto report = collider.cover({}, skin, {.tolerance_m = kTolerance_m});
    CHECK(report.uncovered == static_cast<std::size_t>(below));
    CHECK(static_cast<std::size_t>(count_below(kTolerance_m + kRounding_m)) <= report.left);
    CHECK(report.left <= report.uncovered / 50);
    CHECK(report.left_m < 2e-3f);
    double risen_m = 0.0;  // by the mean over the skin
    for (const Vec3& v : skin)
      risen_m += double{distance_m(without, v) - distance_m(collider, v)} / static_cast<double>(skin.size());
    CHECK(risen_m < 0.15e-3);
    REQUIRE(collider.pose(poser.posed(), 0.0));
    CHECK(std::ranges::all_of(
        skin, [&](const Vec3& v) { return distance_m(collider, v) == distance_m(without, v); }));
  }
}
