// Armpits and crotch against the positions that limbs predict: whole bodies pass, displaced folds do not.
#include <doctest/doctest.h>

#include <map>
#include <utility>

#include <bodice/synth/body.hpp>

#include "analyzed.hpp"
#include "check/fold_doubts.hpp"
#include "check/fold_levels.hpp"

using namespace bodice;
using anatomy::fold_misfit;
using body::LandmarkId;

namespace {

anatomy::Anatomy make_found(synth::Pose pose, double childhood) {
  synth::BodyOptions options;
  options.pose = pose;
  options.childhood = childhood;
  if (childhood > 0.0) options.stature_m = 1.0, options.mass_kg = 16.0;
  const auto body = synth::make_body({}, options);
  REQUIRE(body.ok());
  return analyzed(body->mesh);
}

/// A copy of what was found on a made body, which is analyzed once for all cases.
anatomy::Anatomy found_on(synth::Pose pose, double childhood = 0.0) {
  static std::map<std::pair<synth::Pose, double>, anatomy::Anatomy> known;
  const std::pair key(pose, childhood);
  const auto at = known.find(key);
  return at != known.end() ? at->second : known.emplace(key, make_found(pose, childhood)).first->second;
}

body::Landmark& mark(anatomy::Anatomy& found, LandmarkId id) {
  return found.landmarks[static_cast<std::size_t>(id)];
}

int doubts(const anatomy::Anatomy& found) {
  return static_cast<int>(std::ranges::count_if(
      found.warnings, [](const engine::Warning& w) { return w.code.ends_with("-uncertain"); }));
}

}  // namespace

TEST_CASE("folds of adults that stand lie where they are expected, and those of others are not judged") {
  for (const auto pose : {synth::Pose::kA, synth::Pose::kT, synth::Pose::kArmsDown}) {
    const auto found = found_on(pose);
    CHECK(anatomy::folds_below_expected(found.landmarks));
    CHECK(fold_misfit(found.landmarks) < 1.0);
  }
  CHECK_FALSE(anatomy::folds_below_expected(found_on(synth::Pose::kSit).landmarks));
  CHECK_FALSE(anatomy::folds_below_expected(found_on(synth::Pose::kArmsUp).landmarks));
  CHECK_FALSE(anatomy::folds_below_expected(found_on(synth::Pose::kA, 1.0).landmarks));
  CHECK_FALSE(anatomy::folds_below_expected({}));
}

TEST_CASE("a fold that a web hides is in doubt: sooner on a skin that was cut or closed") {
  for (const LandmarkId id : {LandmarkId::kArmpitL, LandmarkId::kArmpitR, LandmarkId::kPerineum}) {
    auto found = found_on(synth::Pose::kArmsDown);
    mark(found, id).position -= 0.045 * found.stature_m * found.up;
    CHECK(fold_misfit(found.landmarks) > 1.0);
    const std::vector<std::uint8_t> closed(4, 1);
    anatomy::Options options;
    options.made_up = closed;
    anatomy::doubt_folds(options, found);
    CHECK(doubts(found) == 1);
    CHECK(mark(found, id).confidence <= 0.3);
  }
  for (const LandmarkId id : {LandmarkId::kArmpitL, LandmarkId::kPerineum}) {
    auto as_given = found_on(synth::Pose::kArmsDown);
    mark(as_given, id).position -= 0.03 * as_given.stature_m * as_given.up;
    anatomy::doubt_folds({}, as_given);
    CHECK(doubts(as_given) == 0);
    mark(as_given, id).position -= 0.04 * as_given.stature_m * as_given.up;
    anatomy::doubt_folds({}, as_given);
    CHECK(doubts(as_given) == (id == LandmarkId::kArmpitL ? 1 : 0));
  }
}

TEST_CASE("armpits of a skin as given are in doubt sooner where both lie low and look unlike folds") {
  struct Case {
    double left, right, confidence;  // how far below where they are expected; of the stature
    int doubted;
  };
  for (const Case& c : {Case{0.033, 0.026, 0.7, 2}, Case{0.033, 0.018, 0.7, 1}, Case{0.033, 0.018, 0.9, 0},
                        Case{0.033, 0.008, 0.7, 0}, Case{0.028, 0.028, 0.7, 2}, Case{0.026, 0.016, 0.7, 0}}) {
    auto found = found_on(synth::Pose::kArmsDown);
    for (int turn = 0; turn < 3; ++turn) {  // each armpit lets expect the other one a little
      const auto below = anatomy::folds_below_expected(found.landmarks);
      REQUIRE(below);
      mark(found, LandmarkId::kArmpitL).position -= (c.left - (*below)[0]) * found.stature_m * found.up;
      mark(found, LandmarkId::kArmpitR).position -= (c.right - (*below)[1]) * found.stature_m * found.up;
    }
    mark(found, LandmarkId::kArmpitL).confidence = mark(found, LandmarkId::kArmpitR).confidence =
        c.confidence;
    mark(found, LandmarkId::kPerineum).confidence = 0.9;
    CAPTURE(c.left);
    CAPTURE(c.right);
    anatomy::doubt_folds({}, found);
    CHECK(doubts(found) == c.doubted);
  }
}

TEST_CASE("a neck that looks unlike one is in doubt where limbs were cut") {
  for (const double confidence : {0.7, 0.8})
    for (const bool cut : {false, true}) {
      auto found = found_on(synth::Pose::kStride);
      mark(found, LandmarkId::kNeck).confidence = confidence;
      if (cut) found.warnings.push_back({"limbs-cut", "", "", ""});
      const int before = doubts(found);
      anatomy::doubt_folds({}, found);
      CHECK(doubts(found) - before == (cut && confidence < 0.75 ? 1 : 0));
    }
}

TEST_CASE(
    "a crotch that looks right on a closed skin is in doubt only where it is far off, or limbs were cut") {
  for (const double confidence : {0.5, 0.9})
    for (const bool cut : {false, true}) {
      auto found = found_on(synth::Pose::kArmsDown);
      const auto below = anatomy::folds_below_expected(found.landmarks);
      REQUIRE(below);
      body::Landmark& crotch = mark(found, LandmarkId::kPerineum);
      crotch.position -= (0.022 - (*below)[2]) * found.stature_m * found.up;
      crotch.confidence = confidence;
      if (cut) found.warnings.push_back({"limbs-cut", "", "", ""});
      const std::vector<std::uint8_t> closed(4, 1);
      anatomy::Options options;
      options.made_up = closed;
      anatomy::doubt_folds(options, found);
      CHECK(doubts(found) == (confidence < 0.85 || cut ? 1 : 0));
    }
}

TEST_CASE("what closes holes hides folds and moves none up: higher armpits of such skin are in doubt later") {
  const std::vector<std::uint8_t> closed(4, 1);
  anatomy::Options options;
  options.made_up = closed;
  for (const double lower : {0.033, -0.033, -0.045})
    for (const bool cut : {false, true}) {
      CAPTURE(lower);
      CAPTURE(cut);
      auto found = found_on(synth::Pose::kArmsDown);
      const auto below = anatomy::folds_below_expected(found.landmarks);
      REQUIRE(below);
      mark(found, LandmarkId::kArmpitL).position -= (lower - (*below)[0]) * found.stature_m * found.up;
      if (cut) found.warnings.push_back({"limbs-cut", "", "", ""});
      anatomy::doubt_folds(options, found);
      CHECK(doubts(found) == (lower == -0.033 && !cut ? 0 : 1));
    }
}
