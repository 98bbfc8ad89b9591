// Skins on which limbs have grown together.
#include <doctest/doctest.h>

#include <algorithm>
#include <span>

#include <bodice/geometry/noise.hpp>
#include <bodice/synth/scan.hpp>
#include <bodice_test/random_build.hpp>

#include "analyzed.hpp"
#include "made.hpp"

using namespace bodice;
using body::LandmarkId;

TEST_CASE("limbs that are welded are cut apart: parts and landmarks are right, with a warning") {
  using body::Part;
  const auto truth = synth::make_body({}, {.pose = synth::Pose::kArmsDown, .vertices = 5000});
  REQUIRE(truth.ok());
  const auto left = made::fused(*truth, truth->mesh, Part::kForearmL, Part::kThighL);
  for (const geometry::TriMesh& welded : {left, made::fused(*truth, left, Part::kForearmR, Part::kThighR),
                                          made::fused(*truth, truth->mesh, Part::kCalfL, Part::kCalfR),
                                          made::fused(*truth, truth->mesh, Part::kThighL, Part::kThighR)}) {
    const anatomy::Anatomy found = analyzed(welded);
    CHECK(std::any_of(found.warnings.begin(), found.warnings.end(),
                      [](const engine::Warning& w) { return w.code == "limbs-cut"; }));
    CHECK(made::agreement(*truth, found.part) > 0.95);
    CHECK(found.stature_m == doctest::Approx(truth->stature_m).epsilon(0.015));
    for (int i = 0; i <= static_cast<int>(LandmarkId::kToeR); ++i) {
      CAPTURE(i);
      CHECK(made::error(*truth, found, static_cast<LandmarkId>(i)) < 0.03);
    }
  }
}

namespace {

double worst_landmark(const synth::ScanPerson& person, const anatomy::Anatomy& found) {
  double worst = 0.0;
  for (std::size_t i = 0; i <= static_cast<std::size_t>(LandmarkId::kToeR); ++i)
    worst = std::max(worst, (found.landmarks[i].position - person.landmarks[i].position).norm());
  return worst / person.stature_m;
}

/// A body that stands, of random build and resolution.
synth::Body made_standing(std::uint64_t seed) {
  auto made = synth::make_body({}, bodice_test::random_build(seed));
  REQUIRE(made.ok());
  return std::move(made).value();
}

}  // namespace

TEST_CASE("thighs that a scanner has grown together far below the crotch are cut apart up to it") {
  struct Case {
    synth::ScanKind kind;
    std::uint64_t seed;
  };
  for (const Case& c : {Case{synth::ScanKind::kFused, 9004},
                        {synth::ScanKind::kFused, 9001},
                        {synth::ScanKind::kClosed, 9004}}) {
    CAPTURE(synth::name(c.kind));
    CAPTURE(c.seed);
    const auto scan = synth::make_scan({}, c.kind, c.seed);
    REQUIRE(scan.ok());
    const geometry::TriMesh skin = made::skin_of(*scan);
    const anatomy::Anatomy found = analyzed(skin);
    CHECK(std::any_of(found.warnings.begin(), found.warnings.end(), [](const engine::Warning& w) {
      return w.code == "limbs-cut" && w.message.find("the crotch") != std::string::npos;
    }));
    CHECK(worst_landmark(scan->persons[0], found) < 0.035);
    CHECK(found.stature_m == doctest::Approx(scan->persons[0].stature_m).epsilon(0.015));
  }
}

TEST_CASE("a crotch that a scanner has closed 3 and 4 % too low is found by the room between the thighs") {
  for (const std::uint64_t seed : {57001u, 57100u}) {
    CAPTURE(seed);
    const auto scan = synth::make_scan({}, synth::ScanKind::kFused, seed);
    REQUIRE(scan.ok());
    const anatomy::Anatomy found = analyzed(made::skin_of(*scan));
    CHECK(worst_landmark(scan->persons[0], found) < 0.025);
    const auto cut = std::ranges::find(found.warnings, "limbs-cut", &engine::Warning::code);
    REQUIRE(cut != found.warnings.end());
    CHECK(cut->remedy.empty());  // webs alone were cut, and no landmark is in doubt
  }
}

TEST_CASE("less of a web is enough where the skin that shows it closes a hole") {
  const synth::Body truth = made_standing(54028);
  const std::vector<std::uint8_t> made_up(truth.mesh.positions.size(), 1);
  const auto cut = [&](std::span<const std::uint8_t> flags) {
    anatomy::Options options{*body::find_profile("ansur2")};
    options.made_up = flags;
    const auto found = anatomy::analyze({}, truth.mesh, options);
    REQUIRE(found.ok());
    return std::ranges::find(found->warnings, "limbs-cut", &engine::Warning::code) != found->warnings.end();
  };
  CHECK(!cut({}));
  CHECK(cut(made_up));
}

TEST_CASE("thighs of whole bodies that meet below the crotch are not cut apart") {
  for (const std::uint64_t seed : {1u, 2u, 3u, 54020u, 54028u, 54135u}) {
    CAPTURE(seed);
    const synth::Body truth = made_standing(seed);
    const anatomy::Anatomy found = analyzed(truth.mesh);
    for (const engine::Warning& w : found.warnings) {
      CAPTURE(w.message);
      CHECK(w.code != "limbs-cut");
      CHECK(w.code != "perineum-uncertain");
    }
    CHECK(made::error(truth, found, LandmarkId::kPerineum) < 0.03);
  }
}

TEST_CASE("noise makes paths along the skin longer, and no standing body taller") {
  for (const std::uint64_t seed : {9100, 9102}) {
    CAPTURE(seed);
    const auto scan = synth::make_scan({}, synth::ScanKind::kStrongNoise, seed);
    REQUIRE(scan.ok());
    const anatomy::Anatomy found = analyzed(made::skin_of(*scan));
    CHECK(found.stature_m == doctest::Approx(scan->persons[0].stature_m).epsilon(0.02));
  }
}

TEST_CASE("a body in a stride, measured by paths along its skin, is no taller without its noise") {
  const auto scan = synth::make_scan({}, synth::ScanKind::kStrongNoise, 12402);
  REQUIRE(scan.ok());
  geometry::TriMesh skin = made::skin_of(*scan);
  const double clean_m = analyzed(scan->persons[0].body).stature_m;
  CHECK(analyzed(skin).stature_m > 1.04 * clean_m);
  skin.positions = geometry::without_noise({}, skin, geometry::noise_of({}, skin));
  CHECK(analyzed(skin).stature_m == doctest::Approx(clean_m).epsilon(0.01));
}

TEST_CASE(
    "arms and thighs that webs of 18 mm join from below to above are parted by the necks between them") {
  for (const std::uint64_t seed : {4u, 20000u, 20003u, 20006u}) {
    CAPTURE(seed);
    const auto scan = synth::make_scan({}, synth::ScanKind::kWebbed, seed);
    REQUIRE(scan.ok());
    const anatomy::Anatomy found = analyzed(made::skin_of(*scan));
    CHECK(std::any_of(found.warnings.begin(), found.warnings.end(),
                      [](const engine::Warning& w) { return w.code == "limbs-cut"; }));
    CHECK(worst_landmark(scan->persons[0], found) < 0.035);
    CHECK(found.stature_m == doctest::Approx(scan->persons[0].stature_m).epsilon(0.015));
  }
}

TEST_CASE("limbs are cut apart up to the predicted folds, and a stride makes no body taller") {
  for (const std::uint64_t seed : {131000u, 131001u, 131005u}) {
    CAPTURE(seed);
    const auto scan = synth::make_scan({}, synth::ScanKind::kClosed, seed);
    REQUIRE(scan.ok());
    const anatomy::Anatomy found = analyzed(made::skin_of(*scan));
    CHECK(worst_landmark(scan->persons[0], found) < 0.022);
    CHECK(found.stature_m == doctest::Approx(scan->persons[0].stature_m).epsilon(0.015));
    CHECK(std::ranges::none_of(found.warnings, [](const engine::Warning& w) {
      return w.code == "armpit-uncertain" || w.code == "perineum-uncertain";
    }));
  }
}

TEST_CASE("webs of a body that leans, which no cut undoes, are refused with what touches") {
  const auto scan = synth::make_scan({}, synth::ScanKind::kWebbed, 20003);
  REQUIRE(scan.ok());
  geometry::TriMesh skin = made::skin_of(*scan);
  const Eigen::AngleAxisd lean(0.25 * EIGEN_PI, geometry::Vec3::UnitZ());
  for (geometry::Vec3& p : skin.positions) p = lean * p;
  const auto found = anatomy::analyze({}, skin, {*body::find_profile("ansur2")});
  REQUIRE(!found.ok());
  CHECK(found.error().code == engine::ErrorCode::kUnusableGeometry);
  CHECK(found.error().message.find("a hand touches a leg") != std::string::npos);
  CHECK(!found.error().remedy.empty());
}
