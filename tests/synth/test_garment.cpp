#include <bodice/synth/garment.hpp>

#include <algorithm>

#include <doctest/doctest.h>
#include <bodice/geometry/mesh_distance.hpp>
#include <bodice/synth/body.hpp>

#include "garment_kinds.hpp"
#include "made_body.hpp"
#include "mesh_facts.hpp"

namespace {

using namespace bodice;
using bodice_test::kAllKinds;
using bodice_test::made;
using geometry::Vec3;
using synth::GarmentKind;
using synth::Pose;

synth::SegmentedBody segmented(const synth::Body& body) {
  return {body.mesh, body.part, body.landmarks, body.stature_m};
}

void check_worn(const synth::Body& body, const geometry::MeshDistance& skin,
                const synth::GarmentOptions& options, bool standing = true) {
  CAPTURE(static_cast<int>(options.kind));
  const auto result = synth::make_garment({}, segmented(body), options);
  REQUIRE_MESSAGE(result.ok(), (result.ok() ? "" : result.error().sentence()));
  const synth::Garment& garment = result.value();
  const auto facts = bodice_test::facts_of(garment.mesh);
  CHECK(facts.components == 1);
  CHECK(facts.repeated_half_edges == 0);
  const bool tunic = options.kind == GarmentKind::kTunic;
  CHECK(facts.boundary_loops == (tunic ? 4 : 2));  // hem, neck and two armholes
  CHECK(facts.euler == (tunic ? -2 : 0));
  if (standing) CHECK(facts.worst_quality > 0.2);  // over a lap the rows are as far apart as it is deep
  double nearest = 1.0, below = 1.0;
  for (const Vec3& p : garment.mesh.positions) nearest = std::min(nearest, skin.signed_distance(p));
  for (std::size_t t = 0; t < garment.mesh.triangles.size(); ++t)
    below = std::min(below, skin.signed_distance((garment.mesh.corner(t, 0) + garment.mesh.corner(t, 1) +
                                                  garment.mesh.corner(t, 2)) /
                                                 3.0));
  CHECK(nearest >= options.ease_m - 1e-9);
  CHECK(below > 0.0);
  CHECK(garment.pinned.empty() == (options.kind != GarmentKind::kSkirt));
}

TEST_CASE("every garment fits every standing body, clear of the skin") {
  using enum body::Sex;
  for (const synth::BodyOptions& options :
       {synth::BodyOptions{},
        {.sex = kMale, .stature_m = 1.8, .mass_kg = 82, .pose = Pose::kT, .vertices = 5000},
        {.stature_m = 1.6, .mass_kg = 84, .vertices = 4000, .seed = 9},
        {.sex = kMale, .stature_m = 1.2, .mass_kg = 24, .vertices = 2000, .seed = 2}}) {
    CAPTURE(options.mass_kg);
    const synth::Body body = made(options);
    const geometry::MeshDistance skin({}, body.mesh);
    for (const GarmentKind kind : kAllKinds) check_worn(body, skin, {.kind = kind});
  }
}

TEST_CASE("a skirt fits a striding and a seated body") {
  for (const Pose pose : {Pose::kStride, Pose::kSit, Pose::kArmsUp}) {
    CAPTURE(static_cast<int>(pose));
    const synth::Body body = made({.pose = pose, .vertices = 4000});
    check_worn(body, geometry::MeshDistance({}, body.mesh), {.kind = GarmentKind::kSkirt}, false);
  }
}

// With rows of equal height, the lap would have one row of cells several times the given edge length.
TEST_CASE("a seated skirt has rows over the lap") {
  const synth::Body body = made({.pose = Pose::kSit, .vertices = 4000});
  const auto skirt = synth::make_garment({}, segmented(body), {});
  REQUIRE(skirt.ok());
  const geometry::TriMesh& mesh = skirt.value().mesh;
  double longest = 0.0;
  for (const geometry::Triangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k)
      longest = std::max(longest, (mesh.positions[t[k]] - mesh.positions[t[(k + 1) % 3]]).norm());
  CHECK(longest < 4.0 * synth::GarmentOptions{}.edge_length_m);
}

TEST_CASE("the garment has the edge length and ease of the options") {
  const synth::Body body = made({});
  const geometry::MeshDistance skin({}, body.mesh);
  for (const GarmentKind kind : kAllKinds) {
    check_worn(body, skin, {.kind = kind, .ease_m = 0.004, .edge_length_m = 0.01});
    check_worn(body, skin, {.kind = kind, .ease_m = 0.02, .edge_length_m = 0.025});
  }
}

TEST_CASE("the skirt is held at its waistband, above where it ends") {
  const synth::Body body = made({});
  const auto skirt = synth::make_garment({}, segmented(body), {});
  REQUIRE(skirt.ok());
  double lowest_pin = 10.0, hem = 10.0;
  for (const auto v : skirt.value().pinned)
    lowest_pin = std::min(lowest_pin, skirt.value().mesh.positions[v].y());
  for (const Vec3& p : skirt.value().mesh.positions) hem = std::min(hem, p.y());
  CHECK(lowest_pin > 0.54 * body.stature_m);
  CHECK(hem == doctest::Approx(0.28 * body.stature_m).epsilon(0.15));
}

TEST_CASE("a body that cannot wear the garment gives an error with one sentence") {
  const synth::Body body = made({.vertices = 2500});
  const auto code_of = [&](const synth::SegmentedBody& wearer, const synth::GarmentOptions& options) {
    const auto garment = synth::make_garment({}, wearer, options);
    REQUIRE(!garment.ok());
    CHECK(!garment.error().remedy.empty());
    return garment.error().code;
  };
  std::vector<body::Part> legless = body.part;
  for (body::Part& part : legless)
    if (part >= body::Part::kThighL) part = body::Part::kHead;
  CHECK(code_of({body.mesh, legless, body.landmarks, body.stature_m}, {}) ==
        engine::ErrorCode::kUnusableGeometry);
  CHECK(code_of({body.mesh, body.part, {}, body.stature_m}, {}) == engine::ErrorCode::kUnusableGeometry);
  CHECK(code_of({body.mesh, {}, body.landmarks, body.stature_m}, {}) == engine::ErrorCode::kUnusableGeometry);
  auto collapsed = body.landmarks;
  for (auto& landmark : collapsed) landmark.position = Vec3::Zero();
  CHECK(code_of({body.mesh, body.part, collapsed, body.stature_m}, {}) ==
        engine::ErrorCode::kUnusableGeometry);
  CHECK(code_of(segmented(body), {.edge_length_m = 0.0}) == engine::ErrorCode::kInvalidArgument);
  CHECK(code_of(segmented(body), {.ease_m = 1.0}) == engine::ErrorCode::kInvalidArgument);
  const synth::Body raised = made({.pose = Pose::kArmsUp, .vertices = 2500});
  CHECK(code_of(segmented(raised), {.kind = GarmentKind::kPoncho}) == engine::ErrorCode::kUnusableGeometry);
  const synth::Body squatting = made({.pose = Pose::kSquat, .vertices = 2500});  // the thighs touch the chest
  CHECK(code_of(segmented(squatting), {.kind = GarmentKind::kTunic}) == engine::ErrorCode::kUnusableGeometry);
}

}  // namespace
