// The last gate: bodies of any build and pose pass, what is analyzed without being a body does not.
#include <doctest/doctest.h>

#include <algorithm>

#include <bodice/anatomy/plausible.hpp>
#include <bodice/synth/body.hpp>
#include <bodice/synth/scan.hpp>
#include <bodice_test/shapes.hpp>

#include "made.hpp"

using namespace bodice;
using geometry::TriMesh;
using geometry::Vec3;

namespace {

anatomy::Options options(bool force) {
  return {.profile = body::find_profile("ansur2").value(), .force = force};
}

/// What contradicts a human body; empty if the analysis took it for one.
std::string judged(const TriMesh& skin) {
  const auto anatomy = anatomy::analyze({}, skin, options(false));
  return anatomy ? std::string() : anatomy.error().message;
}

}  // namespace

TEST_CASE("made bodies of any build, age and pose are human") {
  using synth::Pose;
  for (const Pose pose : {Pose::kA, Pose::kArmsUp, Pose::kSit, Pose::kSquat, Pose::kRandom})
    for (const double bmi : {17.0, 24.0, 42.0})
      for (const double childhood : {0.0, 1.0}) {
        if (childhood > 0.0 && bmi > 20.0) continue;
        synth::BodyOptions made{.pose = pose, .vertices = 3000, .seed = 5, .childhood = childhood};
        made.stature_m = childhood > 0.0 ? 0.86 : 1.7;
        made.mass_kg = bmi * made.stature_m * made.stature_m;
        const auto body = synth::make_body({}, made);
        REQUIRE(body.ok());
        CAPTURE(static_cast<int>(pose));
        CAPTURE(bmi);
        CAPTURE(childhood);
        CHECK(judged(body->mesh) == "");
      }
}

TEST_CASE("boxes, balls and a body stretched to a pole are not human") {
  CHECK(!judged(bodice_test::box(Vec3::Constant(0.5), 12)).empty());
  CHECK(!judged(bodice_test::box({0.2, 0.9, 0.1}, 12)).empty());
  CHECK(!judged(bodice_test::icosphere(0.5, 4)).empty());
  auto body = synth::make_body({}, {.vertices = 3000});
  REQUIRE(body.ok());
  for (Vec3& p : body->mesh.positions) p.y() *= 3.0;
  CHECK(!judged(body->mesh).empty());
}

TEST_CASE("a bun of hair is named where it stands off the head, a bare head is not") {
  for (const std::uint64_t seed : {9600, 9605, 40007, 40105, 40107}) {
    CAPTURE(seed);
    const auto scan = synth::make_scan({}, synth::ScanKind::kBunAndHem, seed);
    REQUIRE(scan.ok());
    const auto names_hair = [](const TriMesh& skin) {
      const auto found = anatomy::analyze({}, skin, options(false));
      REQUIRE(found.ok());
      return std::any_of(found->warnings.begin(), found->warnings.end(), [](const engine::Warning& w) {
        return w.code == "crown-disagrees" && w.message.find("stands off the head") != std::string::npos;
      });
    };
    CHECK(names_hair(made::skin_of(*scan)));
    CHECK(!names_hair(scan->persons[0].body));
  }
}

TEST_CASE("a bun of hair moves neither the crown nor the stature, wherever it is tied") {
  constexpr auto kCrown = static_cast<std::size_t>(body::LandmarkId::kCrown);
  for (const std::uint64_t seed : {9600, 9601, 9602, 9603, 9604, 40007, 40105, 40107, 40108, 40109}) {
    CAPTURE(seed);
    const auto scan = synth::make_scan({}, synth::ScanKind::kBunAndHem, seed);
    REQUIRE(scan.ok());
    const synth::ScanPerson& truth = scan->persons[0];
    const auto found = anatomy::analyze({}, made::skin_of(*scan), options(false));
    REQUIRE(found.ok());
    CHECK(found->stature_m == doctest::Approx(truth.stature_m).epsilon(0.02));
    const Vec3 off = found->landmarks[kCrown].position - truth.landmarks[kCrown].position;
    CHECK(off.norm() < 0.03 * truth.stature_m);
  }
}

TEST_CASE("a body in one skin with its chair is refused for the flat surface") {
  for (const std::uint64_t seed : {9000, 9002, 9103}) {
    CAPTURE(seed);
    const auto scan = synth::make_scan({}, synth::ScanKind::kChairFused, seed);
    REQUIRE(scan.ok());
    const std::string why = judged(made::skin_of(*scan));
    CHECK_MESSAGE(why.find("as flat as furniture") != std::string::npos, why);
    CHECK(judged(scan->persons[0].body) == "");
  }
}

TEST_CASE("two people in one skin, one of them taken for an arm, are refused") {
  const auto scan = synth::make_scan({}, synth::ScanKind::kTwoFused, 12402);
  REQUIRE(scan.ok());
  const std::string why = judged(made::skin_of(*scan));
  CHECK_MESSAGE(why.find("both welded") != std::string::npos, why);
  CHECK(judged(scan->persons[0].body) == "");
}

TEST_CASE("hands and legs that stay welded are those of two bodies where most landmarks are in doubt") {
  const auto body = synth::make_body({}, synth::BodyOptions{});
  REQUIRE(body.ok());
  auto found = anatomy::analyze({}, body->mesh, options(false));
  REQUIRE(found.ok());
  for (const char* code : {"legs-fused", "neck-uncertain", "neck-disagrees", "perineum-uncertain",
                           "armpit-uncertain", "armpit-uncertain"})
    found->warnings.push_back({code, "", "", ""});
  auto one_less = *found;
  one_less.warnings.push_back({"hand-fused-to-leg", "", "", ""});
  CHECK(anatomy::contradictions(body->mesh, one_less).empty());
  found->warnings.push_back({"crown-disagrees", "", "", ""});
  CHECK(anatomy::contradictions(body->mesh, *found).empty());
  found->warnings.push_back({"hand-fused-to-leg", "", "", ""});
  CHECK(anatomy::contradictions(body->mesh, *found).size() == 1);
}

TEST_CASE("with force, what is analyzed but not human gives a warning with the reason") {
  const TriMesh box = bodice_test::box(Vec3::Constant(0.5), 12);
  const std::string why = judged(box);
  REQUIRE(why.find("times that of a body of its height") != std::string::npos);
  const auto forced = anatomy::analyze({}, box, options(true));
  REQUIRE(forced.ok());
  CHECK(std::any_of(forced->warnings.begin(), forced->warnings.end(),
                    [](const engine::Warning& w) { return w.code == "not-human"; }));
}
