// Folds that limbs and trunk contradict, and the height of bodies in a stride.
#include <doctest/doctest.h>

#include <algorithm>
#include <map>

#include <bodice/synth/body.hpp>

#include "analyze/expected_folds.hpp"
#include "analyze/folds_to_wall.hpp"
#include "analyze/low_armpits.hpp"
#include "analyze/upright_height.hpp"
#include "analyzed.hpp"
#include "check/fold_levels.hpp"

using namespace bodice;
using body::LandmarkId;

namespace {

struct Made {
  synth::Body truth;
  anatomy::Anatomy found;
};

/// A body in a pose and what is found on it, once for all cases; each changes a copy.
Made made_in(synth::Pose pose) {
  static std::map<synth::Pose, Made> made;
  const auto known = made.find(pose);
  if (known != made.end()) return known->second;
  auto truth = synth::make_body({}, {.pose = pose, .vertices = 5000});
  REQUIRE(truth.ok());
  return made.emplace(pose, Made{*truth, analyzed(truth->mesh)}).first->second;
}

body::Landmark& landmark_of(anatomy::Anatomy& found, LandmarkId id) {
  return found.landmarks[static_cast<std::size_t>(id)];
}

}  // namespace

TEST_CASE("a fold that was found far too low or too high is expected near to where it is") {
  const Made made = made_in(synth::Pose::kArmsDown);
  for (const LandmarkId id : {LandmarkId::kArmpitL, LandmarkId::kArmpitR, LandmarkId::kPerineum})
    for (const double lower : {0.05, -0.05}) {
      CAPTURE(lower);
      anatomy::Anatomy moved = made.found;
      const geometry::Vec3 truth = landmark_of(moved, id).position;
      landmark_of(moved, id).position -= lower * moved.stature_m * moved.up;
      const auto folds = anatomy::expected_folds({}, made.truth.mesh, moved);
      REQUIRE(folds.size() == 3);
      for (const anatomy::Fold& fold : folds) {
        const geometry::Vec3& at = fold.id == id ? truth : landmark_of(moved, fold.id).position;
        const double off = std::abs((fold.at - at).dot(moved.up)) / moved.stature_m;
        if (fold.id != LandmarkId::kPerineum || fold.id == id) CHECK(off < 0.025);
      }
    }
  CHECK(anatomy::expected_folds({}, made.truth.mesh, made.found).empty());
}

TEST_CASE("a fold that was found very far off stays in doubt where it was moved to") {
  const Made made = made_in(synth::Pose::kArmsDown);
  struct Case {
    double lower;
    int doubted;
  };
  for (const Case& c : {Case{0.024, 0}, Case{0.035, 1}}) {
    anatomy::Anatomy before = made.found, after = made.found;
    const auto below = anatomy::folds_below_expected(before.landmarks);
    REQUIRE(below);
    landmark_of(before, LandmarkId::kPerineum).position -=
        (c.lower - (*below)[2]) * before.stature_m * before.up;
    anatomy::doubt_moved_folds({}, made.truth.mesh, before, after);
    CHECK(std::ranges::count(after.warnings, "perineum-uncertain", &engine::Warning::code) == c.doubted);
  }
}

TEST_CASE("an armpit that lies too low shows a web where the skin closes holes") {
  Made made = made_in(synth::Pose::kArmsDown);
  const geometry::Vec3 truth = landmark_of(made.found, LandmarkId::kArmpitL).position;
  landmark_of(made.found, LandmarkId::kArmpitL).position -= 0.05 * made.found.stature_m * made.found.up;
  // Without skin around the armpit, the room inside the body is no evidence.
  CHECK(anatomy::webs_by_level({}, {}, {}, made.found).empty());
  const std::vector<std::uint8_t> closed(4, 1);
  anatomy::Options options;
  options.made_up = closed;
  const auto webs = anatomy::webs_by_level({}, {}, options, made.found);
  REQUIRE(webs.size() == 1);
  CHECK(webs[0].id == LandmarkId::kArmpitL);
  CHECK(std::abs((webs[0].fold - truth).dot(made.found.up)) < 0.02 * made.found.stature_m);
}

TEST_CASE("an armpit that is a little too low by limbs and by the room inside the body is found by both") {
  const Made made = made_in(synth::Pose::kArmsDown);
  const geometry::TriMesh& skin = made.truth.mesh;
  const auto was_below = anatomy::folds_below_expected(made.found.landmarks);
  REQUIRE(was_below);
  CHECK(std::ranges::max(anatomy::armpits_too_low({}, skin, made.found)) == 0.0);
  CHECK(anatomy::webs_by_level({}, skin, {}, made.found).empty());
  for (std::size_t side = 0; side < 2; ++side) {
    CAPTURE(side);
    const LandmarkId id = body::of_side(LandmarkId::kArmpitL, static_cast<int>(side));
    anatomy::Anatomy low = made.found;
    const geometry::Vec3 truth = landmark_of(low, id).position;
    const double lower = 0.022 - (*was_below)[side];
    landmark_of(low, id).position -= lower * low.stature_m * low.up;
    REQUIRE(anatomy::fold_misfit(low.landmarks) <= 1.0);
    const auto up = anatomy::armpits_too_low({}, skin, low);
    CHECK(std::abs(up[side] - lower) < 0.01);
    CHECK(up[1 - side] == 0.0);

    const auto webs = anatomy::webs_by_level({}, skin, {}, low);
    REQUIRE(webs.size() == 1);
    CHECK(webs[0].id == id);
    CHECK(std::abs((webs[0].fold - truth).dot(low.up)) < 0.01 * low.stature_m);
    const auto folds = anatomy::expected_folds({}, skin, low);
    const auto fold = std::ranges::find(folds, id, &anatomy::Fold::id);
    REQUIRE(fold != folds.end());
    CHECK(std::abs((fold->at - truth).dot(low.up)) < 0.01 * low.stature_m);
  }
}

TEST_CASE("an armpit that is still too low by both is doubted once") {
  const Made made = made_in(synth::Pose::kArmsDown);
  anatomy::Anatomy low = made.found;
  const auto doubts = [&] {
    return std::ranges::count(low.warnings, "armpit-uncertain", &engine::Warning::code);
  };
  anatomy::doubt_low_armpits({}, made.truth.mesh, low);
  CHECK(doubts() == 0);
  landmark_of(low, LandmarkId::kArmpitR).position -= 0.03 * low.stature_m * low.up;
  for (int again = 0; again < 2; ++again) anatomy::doubt_low_armpits({}, made.truth.mesh, low);
  CHECK(doubts() == 1);
  CHECK(low.warnings.back().part == body::name(body::Part::kUpperArmR));
  CHECK(landmark_of(low, LandmarkId::kArmpitR).confidence < 0.5);
}

TEST_CASE("a crotch that is too high by limbs and by the room inside the body is doubted once") {
  const Made made = made_in(synth::Pose::kArmsDown);
  anatomy::Anatomy high = made.found;
  const auto doubts = [&] {
    return std::ranges::count(high.warnings, "perineum-uncertain", &engine::Warning::code);
  };
  anatomy::doubt_high_crotch({}, made.truth.mesh, high);
  CHECK(doubts() == 0);
  landmark_of(high, LandmarkId::kPerineum).position += 0.035 * high.stature_m * high.up;
  for (int again = 0; again < 2; ++again) anatomy::doubt_high_crotch({}, made.truth.mesh, high);
  CHECK(doubts() == 1);
  CHECK(landmark_of(high, LandmarkId::kPerineum).confidence < 0.5);
}

TEST_CASE("armpits of raised arms that skin and copy have alike need no wall, and all others do") {
  for (const auto pose : {synth::Pose::kT, synth::Pose::kArmsDown}) {
    const Made made = made_in(pose);
    const std::vector<anatomy::Fold> folds = anatomy::find_folds({}, made.truth.mesh, made.found);
    REQUIRE(folds.size() == 3);
    const auto few = anatomy::folds_to_wall(folds, {}, made.found, made.found);
    CHECK(few.size() == (pose == synth::Pose::kT ? 1 : 3));
    CHECK(few.back().id == LandmarkId::kPerineum);

    const anatomy::Web web{LandmarkId::kArmpitL};
    const std::size_t with_web = pose == synth::Pose::kT ? 2 : 3;
    CHECK(anatomy::folds_to_wall(folds, {web}, made.found, made.found).size() == with_web);
    anatomy::Anatomy low = made.found;
    landmark_of(low, LandmarkId::kArmpitR).position -= 0.03 * low.stature_m * low.up;
    CHECK(anatomy::folds_to_wall(folds, {}, made.found, low).size() == with_web);
  }
}

TEST_CASE("the height by joints holds for bodies that stand or stride, also where a web lowers the crotch") {
  for (const auto pose : {synth::Pose::kA, synth::Pose::kStride}) {
    Made made = made_in(pose);
    for (int lowered = 0; lowered < 2; ++lowered) {
      CAPTURE(lowered);
      const auto height_m = anatomy::upright_height(made.found);
      REQUIRE(height_m);
      CHECK(*height_m == doctest::Approx(made.truth.stature_m).epsilon(0.015));
      landmark_of(made.found, LandmarkId::kPerineum).position -= 0.02 * made.found.stature_m * made.found.up;
    }
  }
  CHECK_FALSE(anatomy::upright_height(made_in(synth::Pose::kSit).found));
}
