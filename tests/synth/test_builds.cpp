#include <algorithm>
#include <cmath>
#include <limits>

#include <doctest/doctest.h>

#include "made_body.hpp"
#include "mesh_facts.hpp"

namespace {

using namespace bodice;
using bodice_test::joint;
using bodice_test::made;
using bodice_test::mark;
using body::LandmarkId;
using geometry::Vec3;
using synth::BodyOptions;
using synth::Pose;

TEST_CASE("a child has a large head and short legs, and is a closed skin like any other") {
  double last_head = 0.0, last_leg = 1.0;
  for (const double childhood : {0.0, 0.3, 0.6, 1.0}) {
    CAPTURE(childhood);
    const double stature = 1.6 - 0.7 * childhood;
    const synth::Body body = made({.stature_m = stature,
                                   .mass_kg = 18.0 * stature * stature,
                                   .vertices = 4000,
                                   .seed = 5,
                                   .childhood = childhood});
    CHECK(bodice_test::facts_of(body.mesh).euler == 2);
    CHECK(geometry::signed_volume(body.mesh) * 1010.0 ==
          doctest::Approx(18.0 * stature * stature).epsilon(0.03));
    const double head = (mark(body, LandmarkId::kCrown).y() - mark(body, LandmarkId::kNeck).y()) / stature;
    const double leg = mark(body, LandmarkId::kPerineum).y() / stature;
    CHECK(head > last_head);
    CHECK(leg < last_leg);
    last_head = head;
    last_leg = leg;
  }
  CHECK(last_leg < 0.40);
}

TEST_CASE("a pregnant body reaches further forward at the waist, and has the requested mass") {
  const auto reach = [](const synth::Body& body) {
    double most = -1.0;
    for (const Vec3& p : body.mesh.positions)
      if (std::abs(p.y() - 0.6 * body.stature_m) < 0.05 * body.stature_m) most = std::max(most, p.z());
    return most;
  };
  const synth::Body body = made({.vertices = 4000, .pregnant = true}), other = made({.vertices = 4000});
  CHECK(bodice_test::facts_of(body.mesh).euler == 2);
  CHECK(reach(body) > reach(other) + 0.02);
  CHECK(geometry::signed_volume(body.mesh) ==
        doctest::Approx(geometry::signed_volume(other.mesh)).epsilon(0.04));
}

TEST_CASE("a very heavy trunk is deep more than broad, and its armpits stay at the shoulders") {
  for (const auto sex : {body::Sex::kFemale, body::Sex::kMale}) {
    const synth::Body body =
        made({.sex = sex, .mass_kg = 40.0 * 1.68 * 1.68, .pose = Pose::kT, .vertices = 6000});
    const Vec3 armpit = mark(body, LandmarkId::kArmpitL), shoulder = joint(body, "shoulder_l");
    CHECK(armpit.x() - shoulder.x() < 0.06 * body.stature_m);
    CHECK(armpit.y() < shoulder.y());
  }
}

TEST_CASE("options out of range are refused in one sentence with a remedy") {
  CHECK(!synth::make_body({}, {.childhood = -0.1}).ok());
  CHECK(!synth::make_body({}, {.childhood = std::numeric_limits<double>::quiet_NaN()}).ok());
  const auto fails = [](const BodyOptions& options) {
    const auto body = synth::make_body({}, options);
    REQUIRE(!body.ok());
    CHECK(!body.error().message.empty());
    CHECK(!body.error().remedy.empty());
    return body.error().code;
  };
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  CHECK(fails({.stature_m = 0.39}) == engine::ErrorCode::kInvalidArgument);
  CHECK(fails({.stature_m = 2.61, .mass_kg = 150}) == engine::ErrorCode::kInvalidArgument);
  CHECK(fails({.stature_m = kNan}) == engine::ErrorCode::kInvalidArgument);
  CHECK(fails({.mass_kg = kNan}) == engine::ErrorCode::kInvalidArgument);
  CHECK(fails({.stature_m = 1.7, .mass_kg = 28}) == engine::ErrorCode::kInvalidArgument);
  CHECK(fails({.stature_m = 1.7, .mass_kg = 204}) == engine::ErrorCode::kInvalidArgument);
  CHECK(fails({.vertices = 100}) == engine::ErrorCode::kInvalidArgument);
  CHECK(fails({.vertices = 50'000'000}) == engine::ErrorCode::kInvalidArgument);
}

}  // namespace
