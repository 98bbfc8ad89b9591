// Burial in the collider: the kernels of every instruction set against the scalar reference.
#include <cmath>
#include <numeric>

#include <doctest/doctest.h>

#include <bodice/collision/collider.hpp>
#include <bodice_test/posed_collider.hpp>

#include "exact/near_field.hpp"
#include "exact/relief_field.hpp"
#include "moving_body.hpp"

using namespace bodice;
using namespace binding_test;
using geometry::Vec3;

TEST_CASE(
    "in a stride, a seat, a squat and with raised arms a collider has the distances and owners of eq. (4') "
    "and (5'), on every instruction set") {
  const MovingBody& moving = moving_body();
  binding::Poser poser = make_poser(moving);
  collision::Collider collider(moving.bound);
  std::uint64_t seed = 20;
  for (const Pose& pose : {stride(moving.body.skeleton), seat(moving.body.skeleton),
                           squat(moving.body.skeleton), arms_up(moving.body.skeleton)}) {
    CAPTURE(seed);
    REQUIRE(poser.pose({}, pose));
    REQUIRE(collider.pose(poser.posed(), 0.0));
    auto points =
        bodice_test::reference_at(moving.bound, poser.posed(), collider,
                                  bodice_test::points_around(posed_skin(moving, pose), 3000, seed++));
    CHECK(points.buried > 30);  // else the pose would not test burial
    CHECK(bodice_test::check_posed_collider(collider, points) <= static_cast<int>(points.x.size()) / 200);
  }
}

TEST_CASE("particles that a posed collider has pushed are outside by the reference with burial") {
  const MovingBody& moving = moving_body();
  binding::Poser poser = make_poser(moving);
  collision::Collider collider(moving.bound);
  for (const Pose& pose : {seat(moving.body.skeleton), arms_up(moving.body.skeleton)}) {
    REQUIRE(poser.pose({}, pose));
    REQUIRE(collider.pose(poser.posed(), 0.0));
    auto points = bodice_test::reference_at(moving.bound, poser.posed(), collider,
                                            bodice_test::points_around(posed_skin(moving, pose), 3000, 5));
    const auto before = points;
    bodice_test::on_every_target([&](const std::string& target) {
      CAPTURE(target);
      points = before;
      const auto report = collider.resolve({}, points.particles(), {.thickness_m = 0.002f});
      CHECK(report.contacts > 500);
      int inside = 0, moved = 0;
      for (std::size_t i = 0; i < points.x.size(); ++i) {
        const Vec3 at =
            Vec3(double{points.x[i]}, double{points.y[i]}, double{points.z[i]}) + collider.origin();
        const double distance = proxy::posed_proxy_distance(moving.bound, poser.posed(), at).distance;
        inside += distance < 0.002 - 3e-5;
        // Particles that were clear of the body must keep their positions.
        moved += before.truth[i].distance > 0.002 + 3e-5 && points.x[i] != before.x[i];
      }
      CHECK(inside <= static_cast<int>(report.pinched));
      CHECK(moved == 0);
    });
  }
}

TEST_CASE("a collider forgets burial with the pose: at rest again it is the collider of the proxy at rest") {
  const MovingBody& moving = moving_body();
  binding::Poser poser = make_poser(moving);
  collision::Collider collider(moving.bound);
  collision::Workspace workspace;
  REQUIRE(poser.pose({}, seat(moving.body.skeleton)));
  const proxy::PosedProxy seated = poser.posed();
  REQUIRE(poser.pose({}, bind_pose(moving.body.skeleton)));
  const proxy::PosedProxy standing = poser.posed();
  auto points = bodice_test::points_around(moving.body.mesh, 2000, 6);
  std::vector<collision::Contact> contacts(points.size());
  // One workspace serves both poses: what it stores of one must not serve the other.
  for (int turn = 0; turn < 4; ++turn) {
    const proxy::PosedProxy& posed = turn % 2 == 0 ? seated : standing;
    REQUIRE(collider.pose(posed, 0.01));
    auto reference = bodice_test::reference_at(moving.bound, posed, collider, points);
    collider.query({}, reference.particles(), contacts, workspace);
    int wrong = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
      wrong += std::abs(double{contacts[i].signed_distance} - reference.truth[i].distance) > 3e-5;
    CHECK(wrong == 0);
  }
}

TEST_CASE("the exact side of a posed collider has the distances and owners of the reference") {
  const MovingBody& moving = moving_body();
  binding::Poser poser = make_poser(moving);
  const collision::Collider at_rest(moving.bound);
  std::vector<std::uint32_t> order(moving.bound.ellipsoids().size());
  std::iota(order.begin(), order.end(), 0u);
  for (const Pose& pose : {seat(moving.body.skeleton), squat(moving.body.skeleton)}) {
    REQUIRE(poser.pose({}, pose));
    collision::ReliefTables tables(moving.bound, order, nullptr);
    tables.update(poser.posed(), moving.bound.stature_m(), order);
    const collision::UnionField field(poser.posed().shapes);
    const auto points = bodice_test::points_around(posed_skin(moving, pose), 1000, 8);
    const bodice_test::PosedPoints reference =
        bodice_test::reference_at(moving.bound, poser.posed(), at_rest, points);
    CHECK(reference.buried > 10);
    const double margin_m = moving.bound.margin_m();
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto truth = proxy::posed_proxy_distance(moving.bound, poser.posed(), points[i]);
      const auto sample = collision::relief_sample(field, tables, points[i]);
      CHECK(std::abs(sample.distance_m - margin_m - truth.distance) < 1e-6);
      CHECK(sample.owner == truth.owner);
      constexpr double kFar_m = 0.04;
      collision::NearField near(field, &tables, 0.0, kFar_m);
      near.prepare(points[i], 0.0);
      const auto evaluated = near.at(points[i]);
      if (truth.distance > kFar_m - 1e-4) continue;
      CHECK(std::abs(evaluated.distance_m - margin_m - truth.distance) < 1e-6);
      CHECK(evaluated.owner == truth.owner);
    }
  }
}
