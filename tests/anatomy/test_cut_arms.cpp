// Arms of bodies that were cut apart.
#include <doctest/doctest.h>

#include <algorithm>

#include <bodice/synth/body.hpp>

#include "analyze/low_armpits.hpp"
#include "analyzed.hpp"
#include "check/unequal_arms.hpp"
#include "made.hpp"

using namespace bodice;
using body::LandmarkId;

namespace {

struct StandingBody {
  synth::Body truth;
  anatomy::Anatomy found;
};

const StandingBody& standing_body() {
  static const StandingBody made = [] {
    auto truth = synth::make_body({}, {.pose = synth::Pose::kArmsDown, .vertices = 5000});
    REQUIRE(truth.ok());
    return StandingBody{*truth, analyzed(truth->mesh)};
  }();
  return made;
}

body::Landmark& mark_in(anatomy::Anatomy& found, LandmarkId id) {
  return found.landmarks[static_cast<std::size_t>(id)];
}

auto count_of(const anatomy::Anatomy& found, const char* code) {
  return std::ranges::count(found.warnings, code, &engine::Warning::code);
}

/// Moves a landmark toward another one; `by` is a fraction of the stature.
void move_toward(anatomy::Anatomy& found, LandmarkId id, LandmarkId other, double by) {
  geometry::Vec3& at = mark_in(found, id).position;
  at += by * found.stature_m * (mark_in(found, other).position - at).normalized();
}

}  // namespace

TEST_CASE("elbows are in doubt where one forearm is longer than the other") {
  for (const double by : {0.0, 0.015, 0.03}) {
    CAPTURE(by);
    anatomy::Anatomy found = standing_body().found;
    // The upper arm keeps its length.
    move_toward(found, LandmarkId::kFingertipR, LandmarkId::kElbowR, by);
    anatomy::doubt_unequal_arms(found);
    CHECK(count_of(found, "elbow-uncertain") == (by > 0.02 ? 2 : 0));
    CHECK(count_of(found, "armpit-uncertain") == 0);
    for (const LandmarkId elbow : {LandmarkId::kElbowL, LandmarkId::kElbowR})
      CHECK((mark_in(found, elbow).confidence < 0.35) == (by > 0.02));
  }
}

TEST_CASE("the armpit that fits less is in doubt where one upper arm is longer than the other") {
  for (const LandmarkId id : {LandmarkId::kArmpitL, LandmarkId::kArmpitR})
    for (const double by : {0.01, 0.03}) {
      CAPTURE(by);
      anatomy::Anatomy found = standing_body().found;
      const int side = id == LandmarkId::kArmpitL ? 0 : 1;
      move_toward(found, id, body::of_side(LandmarkId::kElbowL, side), by);
      for (int again = 0; again < 2; ++again) anatomy::doubt_unequal_arms(found);
      CHECK(count_of(found, "elbow-uncertain") == 0);
      CHECK(count_of(found, "armpit-uncertain") == (by > 0.02 ? 1 : 0));
      CHECK((mark_in(found, id).confidence < 0.35) == (by > 0.02));
    }
}

TEST_CASE("an armpit is in doubt where one lies farther from the neck than the other") {
  for (const double by : {0.02, 0.035}) {
    CAPTURE(by);
    anatomy::Anatomy found = standing_body().found;
    geometry::Vec3& armpit = mark_in(found, LandmarkId::kArmpitL).position;
    const geometry::Vec3 arm = (mark_in(found, LandmarkId::kElbowL).position - armpit).normalized();
    const geometry::Vec3 collar = armpit - mark_in(found, LandmarkId::kNeck).position;
    const geometry::Vec3 aside = collar - collar.dot(arm) * arm;  // the upper arm keeps its length
    armpit += by * found.stature_m / aside.normalized().dot(collar.normalized()) * aside.normalized();
    for (int again = 0; again < 2; ++again) anatomy::doubt_unequal_arms(found);
    CHECK(count_of(found, "elbow-uncertain") == 0);
    CHECK(count_of(found, "armpit-uncertain") == (by > 0.03 ? 1 : 0));
  }
}

TEST_CASE("an armpit far below the fold that the room inside the body shows is in doubt by that alone") {
  const StandingBody& made = standing_body();
  for (const double lower : {0.0, 0.06}) {
    CAPTURE(lower);
    anatomy::Anatomy found = made.found;
    mark_in(found, LandmarkId::kArmpitL).position -= lower * found.stature_m * found.up;
    anatomy::doubt_armpits_by_room({}, made.truth.mesh, found);
    CHECK(count_of(found, "armpit-uncertain") == (lower > 0.0 ? 1 : 0));
  }
}

TEST_CASE("an arm that lost its fingers in a cut is in doubt, and a correct stride is not") {
  struct Case {
    std::uint64_t seed;
    int doubted;
  };
  for (const Case& c : {Case{170000, 2}, Case{160004, 0}}) {
    CAPTURE(c.seed);
    const auto scan = synth::make_scan({}, synth::ScanKind::kClosed, c.seed);
    REQUIRE(scan.ok());
    const anatomy::Anatomy found = analyzed(made::skin_of(*scan));
    CHECK(count_of(found, "elbow-uncertain") == c.doubted);
    const auto cut = std::ranges::find(found.warnings, "limbs-cut", &engine::Warning::code);
    REQUIRE(cut != found.warnings.end());
    if (c.doubted == 0) CHECK(cut->note);
    for (const LandmarkId id : {LandmarkId::kFingertipL, LandmarkId::kFingertipR}) {
      const auto at = static_cast<std::size_t>(id);
      const geometry::Vec3& truth = scan->persons[0].landmarks[at].position;
      CHECK((found.landmarks[at].position - truth).norm() < 0.01 * scan->persons[0].stature_m);
    }
  }
}
