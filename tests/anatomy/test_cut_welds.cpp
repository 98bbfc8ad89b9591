// Skins on which limbs have grown together.
#include <doctest/doctest.h>

#include <algorithm>

#include <bodice/synth/scan.hpp>

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

TEST_CASE("webs of 18 mm that no cut undoes are refused with a sentence that names what touches") {
  const auto scan = synth::make_scan({}, synth::ScanKind::kWebbed, 4);
  REQUIRE(scan.ok());
  geometry::TriMesh skin = scan->meshes[0].shape;
  for (geometry::Vec3& p : skin.positions) p = scan->frame.to_inside(p);
  const auto found = anatomy::analyze({}, skin, {*body::find_profile("ansur2")});
  REQUIRE(!found.ok());
  CHECK(found.error().code == engine::ErrorCode::kUnusableGeometry);
  CHECK(found.error().message.find("a hand touches a leg") != std::string::npos);
  CHECK(!found.error().remedy.empty());
}
