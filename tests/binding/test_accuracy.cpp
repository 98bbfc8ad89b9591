// Judged by the exact signed distance of the posed skin.
#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include <bodice/engine/random.hpp>
#include <bodice/geometry/mesh_distance.hpp>
#include <bodice/geometry/sampling.hpp>

#include "moving_body.hpp"

using namespace bodice;
using namespace binding_test;
using geometry::Vec3;

namespace {

struct Errors {
  double mean_mm = 0.0, p95_mm = 0.0;
  double missed_percent = 0.0, false_percent = 0.0;
};

/// Errors within 30 mm of the posed skin, without points in or next to overlapping skin.
Errors errors_of(const MovingBody& moving, const binding::Poser& poser, const Pose& pose) {
  const engine::Context context;
  const geometry::TriMesh skin = posed_skin(moving, pose);
  const geometry::MeshDistance distance(context, skin);
  const engine::Random random(5);
  std::vector<double> errors;
  int missed = 0, falsely_hit = 0;
  std::uint64_t draw = 0;
  for (const auto& sample : geometry::sample_surface(skin, 3000, 7)) {
    const Vec3 normal = geometry::area_vector(skin, sample.triangle).normalized();
    const Vec3 point = sample.point + (0.06 * random.uniform_at(draw++) - 0.03) * normal;
    const auto truth = distance.closest_point(point);
    if (std::abs(truth.signed_distance) > 0.03 || distance.winding_number(point) > 1.5) continue;
    const bool inside = truth.signed_distance < 0.0;
    if (inside && distance.winding_number(truth.point + 1e-4 * truth.normal) > 0.5) continue;
    const double found = proxy::posed_proxy_distance(moving.bound, poser.posed(), point).distance;
    errors.push_back(1e3 * std::abs(found - truth.signed_distance));
    missed += truth.signed_distance < -1e-3 && found > 0.0;
    falsely_hit += truth.signed_distance > 1e-3 && found < 0.0;
  }
  REQUIRE(errors.size() > 2000);
  std::ranges::sort(errors);
  Errors result;
  for (const double error : errors) result.mean_mm += error / static_cast<double>(errors.size());
  result.p95_mm = errors[errors.size() * 95 / 100];
  result.missed_percent = 100.0 * missed / static_cast<double>(errors.size());
  result.false_percent = 100.0 * falsely_hit / static_cast<double>(errors.size());
  return result;
}

}  // namespace

TEST_CASE("a marching body's posed proxy errs by less than .8 mm on average and 2.8 mm at 95 %") {
  const MovingBody& moving = moving_body();
  binding::Poser poser = make_poser(moving);
  const Pose pose = march(moving.body.skeleton);
  REQUIRE(poser.pose({}, pose));
  const Errors errors = errors_of(moving, poser, pose);
  CAPTURE(errors.mean_mm);
  CAPTURE(errors.p95_mm);
  CHECK(errors.mean_mm < 0.8);
  CHECK(errors.p95_mm < 2.8);
  CHECK(errors.missed_percent < 0.3);
  CHECK(errors.false_percent < 0.5);
}

TEST_CASE("a seated body's posed proxy errs by less than 1.1 mm on average and 4.5 mm at 95 %") {
  const MovingBody& moving = moving_body();
  binding::Poser poser = make_poser(moving);
  const Pose pose = seat(moving.body.skeleton);
  REQUIRE(poser.pose({}, pose));
  const Errors errors = errors_of(moving, poser, pose);
  CAPTURE(errors.mean_mm);
  CAPTURE(errors.p95_mm);
  CHECK(errors.mean_mm < 1.1);
  CHECK(errors.p95_mm < 4.5);
}

TEST_CASE("tables that follow the skin halve the mean error of ellipsoids that are carried alone") {
  const MovingBody& moving = moving_body();
  binding::Poser poser = make_poser(moving);
  const Pose pose = march(moving.body.skeleton);
  REQUIRE(poser.pose({}, pose, {.tables = false}));
  const double carried_mm = errors_of(moving, poser, pose).mean_mm;
  REQUIRE(poser.pose({}, pose));
  CHECK(errors_of(moving, poser, pose).mean_mm < 0.5 * carried_mm);
}
