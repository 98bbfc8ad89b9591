// Colliders that cover the host's skin, through the C interface.
#include <algorithm>
#include <cmath>

#include <bodice/binding/poser.hpp>

#include "capi/arm.hpp"
#include "capi/scene.hpp"

using namespace capi_test;

TEST_CASE("capi: a collider covers the host's skin as the engine's does, until the next pose") {
  const Arm arm;
  const auto bound = arm.bound();
  const Joints bent = arm.bent();
  Scene scene(bound);
  auto poser = bodice::binding::Poser::make(bound);
  REQUIRE(poser);
  REQUIRE(poser->pose({}, bent));
  REQUIRE(scene.engine.pose(poser->posed(), 0.0));
  std::vector<float> rows;
  for (const auto& m : bent)
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 4; ++c) rows.push_back(static_cast<float>(m(r, c)));
  bodice_pose pose = bodice_default_pose();
  pose.matrices = rows.data();
  pose.count = 2;
  REQUIRE(bodice_collider_pose(scene.collider.get(), &pose) == BODICE_OK);

  // A skin 2 mm over the surface around the elbow, as floats in structures of four.
  std::vector<float> skin;
  std::vector<bodice_test::Vec3> points;
  bodice::engine::Random random(8);
  while (points.size() < 400) {
    const bodice_test::Vec3 at = bodice_test::Vec3(0.2, 0.1, -0.1) + bodice_test::random_vector(random, 0.07);
    const Eigen::Vector3f local = (at - scene.engine.origin()).cast<float>();
    const auto contact = scene.engine.query({local.x(), local.y(), local.z()});
    if (contact.signed_distance < 0.001f || contact.signed_distance > 0.003f) continue;
    const Eigen::Vector3f rounded = at.cast<float>();
    skin.insert(skin.end(), {rounded.x(), rounded.y(), rounded.z(), 7.0f});
    points.push_back(rounded.cast<double>());
  }
  const auto distances = [&] { return contacts_at(scene, points); };
  const auto before = distances();
  const bodice::Points given(points.size(), skin.data(), 4 * sizeof(float));
  const auto uncovered = scene.collider.cover(given, 0.5e-3f);
  REQUIRE_MESSAGE(uncovered, bodice_last_error());
  CHECK(*uncovered == points.size());
  scene.engine.cover({}, points, {.tolerance_m = 0.5e-3f});
  const auto covered = distances();
  std::size_t left = 0, unlike = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3f local = (points[i] - scene.engine.origin()).cast<float>();
    left += covered[i].distance > 0.7e-3f;
    unlike += std::abs(scene.engine.query({local.x(), local.y(), local.z()}).signed_distance -
                       covered[i].distance) > 2e-6f;
  }
  CHECK(left <= points.size() / 50);
  CHECK(unlike == 0);
  REQUIRE(bodice_collider_pose(scene.collider.get(), &pose) == BODICE_OK);
  const auto after = distances();
  CHECK(std::ranges::equal(before, after, {}, &bodice_contact::distance, &bodice_contact::distance));
  if (!bodice_test::counts_allocations()) return;
  CHECK(bodice_test::allocations_when_warm(3, [&] {
          REQUIRE(bodice_collider_pose(scene.collider.get(), &pose) == BODICE_OK);
          REQUIRE(scene.collider.cover(given));
        }) == 0);
}
