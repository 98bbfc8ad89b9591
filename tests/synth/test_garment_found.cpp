// Garments on found bodies: with landmarks and parts of analyze() in place of the truth of a made body.
#include <algorithm>
#include <array>
#include <cmath>

#include <doctest/doctest.h>
#include <bodice/anatomy/anatomy.hpp>
#include <bodice/geometry/mesh_distance.hpp>
#include <bodice/synth/body.hpp>
#include <bodice/synth/garment.hpp>
#include <bodice_test/data.hpp>
#include <bodice_test/read_mesh.hpp>

#include "garment_kinds.hpp"
#include "mesh_facts.hpp"

namespace {

using namespace bodice;
using bodice_test::kAllKinds;
using geometry::Vec3;
using synth::GarmentKind;

anatomy::Anatomy found(const geometry::TriMesh& mesh) {
  auto anatomy = anatomy::analyze({}, mesh, {body::find_profile("ansur2").value()});
  REQUIRE_MESSAGE(anatomy.ok(), (anatomy.ok() ? "" : anatomy.error().sentence()));
  return std::move(anatomy).value();
}

geometry::TriMesh built_in(const synth::BodyOptions& options) {
  auto body = synth::make_body({}, options);
  REQUIRE(body.ok());
  return std::move(body.value().mesh);
}

void check_worn(const geometry::MeshDistance& skin, const synth::SegmentedBody& wearer, GarmentKind kind) {
  CAPTURE(static_cast<int>(kind));
  const synth::GarmentOptions options{.kind = kind};
  const auto result = synth::make_garment({}, wearer, options);
  REQUIRE_MESSAGE(result.ok(), (result.ok() ? "" : result.error().sentence()));
  const geometry::TriMesh& cloth = result.value().mesh;
  const auto facts = bodice_test::facts_of(cloth);
  CHECK(facts.components == 1);
  CHECK(facts.repeated_half_edges == 0);
  CHECK(facts.boundary_loops == (kind == GarmentKind::kTunic ? 4 : 2));
  CHECK(facts.worst_quality > 0.2);
  double nearest = 1.0, middle = 1.0;
  for (const Vec3& p : cloth.positions) nearest = std::min(nearest, skin.signed_distance(p));
  for (std::size_t t = 0; t < cloth.triangles.size(); ++t)
    middle = std::min(
        middle, skin.signed_distance((cloth.corner(t, 0) + cloth.corner(t, 1) + cloth.corner(t, 2)) / 3.0));
  CHECK(nearest >= options.ease_m - 1e-9);
  CHECK(middle > 0.0);
}

void check_wardrobe(const geometry::TriMesh& mesh) {
  const anatomy::Anatomy anatomy = found(mesh);
  const geometry::MeshDistance skin({}, mesh);
  const synth::SegmentedBody wearer{mesh, anatomy.part, anatomy.landmarks, anatomy.stature_m};
  for (const GarmentKind kind : kAllKinds) check_worn(skin, wearer, kind);
}

TEST_CASE("every garment fits the built-in body by the landmarks that are found on it") {
  using enum body::Sex;
  for (const synth::BodyOptions& options :
       {synth::BodyOptions{},
        {.pose = synth::Pose::kT},
        {.vertices = 3000, .seed = 1},
        {.sex = kMale, .stature_m = 1.78, .mass_kg = 80, .vertices = 5000, .seed = 2},
        {.sex = kMale, .pose = synth::Pose::kT, .vertices = 3000, .seed = 3},
        {.sex = kMale, .vertices = 13000}}) {
    CAPTURE(static_cast<int>(options.sex));
    CAPTURE(static_cast<int>(options.pose));
    CAPTURE(options.vertices);
    check_wardrobe(built_in(options));
  }
}

TEST_CASE("every garment fits real bodies at rest") {
  for (const char* name :
       {"bodies/f_avg_rest.obj", "bodies/f_heavy_rest.obj", "bodies/m_old_heavy_rest.obj"}) {
    CAPTURE(name);
    if (const auto file = bodice_test::data_file(name)) check_wardrobe(bodice_test::read_mesh(*file));
  }
}

TEST_CASE("a neck's border that runs over the shoulders does not keep a poncho from fitting") {
  auto body =
      synth::make_body({}, {.sex = body::Sex::kMale, .pose = synth::Pose::kT, .vertices = 3000, .seed = 3})
          .value();
  const geometry::MeshDistance skin({}, body.mesh);
  const Vec3 neck = body.landmarks[static_cast<std::size_t>(body::LandmarkId::kNeck)].position;
  std::size_t on_shoulders = 0;
  for (std::size_t v = 0; v < body.part.size(); ++v) {
    const Vec3 from_neck = body.mesh.positions[v] - neck;
    const bool on_shoulder =
        std::abs(from_neck.x()) < 0.13 && std::abs(from_neck.z()) < 0.045 && from_neck.y() > -0.03;
    if (!on_shoulder || body.part[v] == body::Part::kHead) continue;
    body.part[v] = body::Part::kHead;
    ++on_shoulders;
  }
  REQUIRE(on_shoulders >= 10);
  check_worn(skin, {body.mesh, body.part, body.landmarks, body.stature_m}, GarmentKind::kPoncho);
}

// A found armpit is a point on a fold some centimeters tall, and borders between parts are not sharply
// defined.
TEST_CASE("landmarks some centimeters off do not keep a garment from fitting") {
  auto body = synth::make_body({}, {.vertices = 4000}).value();
  const geometry::MeshDistance skin({}, body.mesh);
  const auto at = [&](body::LandmarkId id) -> Vec3& {
    return body.landmarks[static_cast<std::size_t>(id)].position;
  };
  const double h = body.stature_m;
  for (const double up : {-0.015, 0.0, 0.015, 0.03})
    for (const double front : {-0.03, 0.03}) {
      CAPTURE(up);
      CAPTURE(front);
      const auto truth = body.landmarks;
      at(body::LandmarkId::kArmpitL) += h * Vec3(0, up, front);
      at(body::LandmarkId::kArmpitR) += h * Vec3(0, up, front);
      at(body::LandmarkId::kPerineum) += h * Vec3(0, 0, front);
      at(body::LandmarkId::kNeck) += h * Vec3(0, 0.5 * up, 0);
      for (const GarmentKind kind : {GarmentKind::kTube, GarmentKind::kTunic})
        check_worn(skin, {body.mesh, body.part, body.landmarks, h}, kind);
      body.landmarks = truth;
    }
}

}  // namespace
