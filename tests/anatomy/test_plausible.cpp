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

struct Analyzed {
  synth::Body body;
  anatomy::Anatomy found;
};

/// The default body, for cases that change copies of what was found on it.
const Analyzed& default_body() {
  static const Analyzed made = [] {
    auto body = synth::make_body({}, synth::BodyOptions{});
    REQUIRE(body.ok());
    auto found = anatomy::analyze({}, body->mesh, options(false));
    REQUIRE(found.ok());
    return Analyzed{std::move(*body), std::move(*found)};
  }();
  return made;
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

TEST_CASE("a body in one skin with its chair is refused for that") {
  for (const std::uint64_t seed : {9000, 9002, 9103}) {
    CAPTURE(seed);
    const auto scan = synth::make_scan({}, synth::ScanKind::kChairFused, seed);
    REQUIRE(scan.ok());
    const std::string why = judged(made::skin_of(*scan));
    CHECK_MESSAGE(why.find("furniture") != std::string::npos, why);
    CHECK(judged(scan->persons[0].body) == "");
  }
}

TEST_CASE("two people in one skin are refused for the ends of the second one") {
  for (const std::uint64_t seed : {12402, 410000, 410014}) {
    CAPTURE(seed);
    const auto scan = synth::make_scan({}, synth::ScanKind::kTwoFused, seed);
    REQUIRE(scan.ok());
    const std::string why = judged(made::skin_of(*scan));
    CHECK_MESSAGE(why.find("a sixth end") != std::string::npos, why);
    CHECK(judged(scan->persons[0].body) == "");
  }
}

TEST_CASE("legs and other limbs that stay welded are those of two bodies where landmarks are in doubt") {
  const geometry::TriMesh& skin = default_body().body.mesh;
  anatomy::Anatomy found = default_body().found;
  for (const char* code :
       {"legs-fused", "limbs-fused", "neck-uncertain", "armpit-uncertain", "armpit-uncertain"})
    found.warnings.push_back({code, "", "", ""});
  CHECK(anatomy::contradictions(skin, found).empty());
  found.warnings.push_back({"crown-disagrees", "", "", ""});
  CHECK(anatomy::contradictions(skin, found).size() == 1);
}

TEST_CASE("hands and legs that stay welded are those of two bodies where most landmarks are in doubt") {
  const geometry::TriMesh& skin = default_body().body.mesh;
  anatomy::Anatomy found = default_body().found;
  for (const char* code : {"legs-fused", "neck-uncertain", "neck-disagrees", "perineum-uncertain",
                           "armpit-uncertain", "armpit-uncertain"})
    found.warnings.push_back({code, "", "", ""});
  anatomy::Anatomy one_less = found;
  one_less.warnings.push_back({"hand-fused-to-leg", "", "", ""});
  CHECK(anatomy::contradictions(skin, one_less).empty());
  found.warnings.push_back({"crown-disagrees", "", "", ""});
  CHECK(anatomy::contradictions(skin, found).empty());
  found.warnings.push_back({"hand-fused-to-leg", "", "", ""});
  CHECK(anatomy::contradictions(skin, found).size() == 1);
}

TEST_CASE("with force, what is analyzed but not human gives a warning with the reason") {
  const TriMesh box = bodice_test::box(Vec3::Constant(0.5), 12);
  const std::string why = judged(box);
  REQUIRE(why.find("a sixth end") != std::string::npos);
  const auto forced = anatomy::analyze({}, box, options(true));
  REQUIRE(forced.ok());
  for (const char* reason : {"a sixth end", "times that of a body of its height"})
    CHECK(std::ranges::any_of(forced->warnings, [&](const engine::Warning& w) {
      return w.code == "not-human" && w.message.find(reason) != std::string::npos;
    }));
}
