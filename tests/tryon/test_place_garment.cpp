// Garments in any unit, with any axis up and a little beside their body are put on it; others are refused.
#include <doctest/doctest.h>

#include <functional>

#include <bodice/synth/body.hpp>
#include <bodice/tryon/place_garment.hpp>
#include <bodice/tryon/prepare.hpp>
#include <bodice/tryon/wearing.hpp>
#include <bodice_test/executors.hpp>

#include "builtin.hpp"

using namespace bodice;
using geometry::Vec3;

namespace {

/// A made body and a tunic that was made for it.
struct InTunic {
  const tryon::SegmentedSkin& skin = builtin_skin(4500);
  geometry::TriMesh tunic;

  InTunic() {
    auto garment = tryon::make_garment({}, skin, {.kind = synth::GarmentKind::kTunic});
    REQUIRE(garment.ok());
    tunic = std::move(garment->mesh);
  }
  engine::Result<std::optional<engine::Warning>> put_on(geometry::TriMesh& garment,
                                                        double meters_per_unit = 1.0) const {
    return tryon::place_garment(
        {}, {*skin.distance, skin.input.skin, skin.anatomy.stature_m, meters_per_unit}, "tunic", garment);
  }
  geometry::TriMesh changed(const std::function<Vec3(const Vec3&)>& by) const {
    geometry::TriMesh mesh = tunic;
    for (Vec3& p : mesh.positions) p = by(p);
    return mesh;
  }
  double farthest_m(const geometry::TriMesh& mesh) const {
    double farthest = 0.0;
    for (std::size_t v = 0; v < mesh.positions.size(); ++v)
      farthest = std::max(farthest, (mesh.positions[v] - tunic.positions[v]).norm());
    return farthest;
  }
};

}  // namespace

TEST_CASE("placement: a garment on its body keeps its bits, without a warning") {
  const InTunic dressed;
  geometry::TriMesh mesh = dressed.tunic;
  const auto placed = dressed.put_on(mesh);
  REQUIRE(placed.ok());
  CHECK(!placed->has_value());
  CHECK(mesh.positions == dressed.tunic.positions);
}

TEST_CASE("placement: another unit or another axis up is found, and the warning names it") {
  const InTunic dressed;
  struct Case {
    double units;
    bool z_up;
    const char* word;
  };
  for (const Case& c : {Case{1000.0, false, "millimeters"}, Case{100.0, false, "centimeters"},
                        Case{1.0 / 0.0254, false, "inches"}, Case{1.0, true, "z up"},
                        Case{1000.0, true, "millimeters, z up"}}) {
    geometry::TriMesh mesh = dressed.changed(
        [&](const Vec3& p) { return Vec3(c.units * (c.z_up ? Vec3(p.x(), -p.z(), p.y()) : p)); });
    const auto placed = dressed.put_on(mesh);
    REQUIRE_MESSAGE(placed.ok(), placed.error().sentence());
    REQUIRE_MESSAGE(placed->has_value(), c.word);
    CHECK((*placed)->code == "garment-placed");
    CHECK_MESSAGE((*placed)->message.find(c.word) != std::string::npos, (*placed)->message);
    CHECK(dressed.farthest_m(mesh) < 1e-9);
  }
}

TEST_CASE("placement: a garment in another unit than a body in millimeters or centimeters is found") {
  const InTunic dressed;
  struct Case {
    double body_unit_m, garment_unit_m;
    const char* word;
  };
  for (const Case& c : {Case{1e-3, 1e-2, "in centimeters"}, Case{1e-3, 1.0, "in meters"},
                        Case{1e-2, 1.0, "in meters"}, Case{1e-2, 1e-3, "in millimeters"}}) {
    geometry::TriMesh mesh =
        dressed.changed([&](const Vec3& p) { return Vec3(p * c.body_unit_m / c.garment_unit_m); });
    const auto placed = dressed.put_on(mesh, c.body_unit_m);
    REQUIRE_MESSAGE(placed.ok(), placed.error().sentence());
    REQUIRE_MESSAGE(placed->has_value(), c.word);
    CHECK_MESSAGE((*placed)->message.find(c.word) != std::string::npos, (*placed)->message);
    CHECK(dressed.farthest_m(mesh) < 1e-9);
  }
}

TEST_CASE("placement: a skirt in front of its body is moved back, and not up") {
  const InTunic dressed;
  auto skirt = tryon::make_garment({}, dressed.skin, {.kind = synth::GarmentKind::kSkirt});
  REQUIRE(skirt.ok());
  geometry::TriMesh mesh = skirt->mesh;
  for (Vec3& p : mesh.positions) p.z() += 0.12;
  const auto placed = dressed.put_on(mesh);
  REQUIRE_MESSAGE(placed.ok(), placed.error().sentence());
  REQUIRE(placed->has_value());
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    REQUIRE(mesh.positions[v].y() == skirt->mesh.positions[v].y());
    REQUIRE((mesh.positions[v] - skirt->mesh.positions[v]).norm() < 0.03);
  }
}

TEST_CASE("placement: a garment 12 or 20 cm in front of its body is moved back onto it") {
  const InTunic dressed;
  for (const double off_m : {0.12, 0.2}) {
    geometry::TriMesh mesh = dressed.changed([&](const Vec3& p) { return Vec3(p + Vec3(0.0, 0.0, off_m)); });
    const auto placed = dressed.put_on(mesh);
    REQUIRE_MESSAGE(placed.ok(), placed.error().sentence());
    REQUIRE_MESSAGE(placed->has_value(), off_m);
    CHECK_MESSAGE((*placed)->message.find("moved by") != std::string::npos, (*placed)->message);
    CHECK(dressed.farthest_m(mesh) < 0.05);
  }
}

TEST_CASE("placement: a garment far from the body in every unit is refused with its size and distance") {
  const InTunic dressed;
  geometry::TriMesh mesh = dressed.changed([](const Vec3& p) { return Vec3(p + Vec3(40.0, 0.0, 0.0)); });
  const auto placed = dressed.put_on(mesh);
  REQUIRE(!placed.ok());
  CHECK(placed.error().code == engine::ErrorCode::kUnusableGeometry);
  CHECK_MESSAGE(placed.error().message.find("m from corner to corner") != std::string::npos,
                placed.error().message);
  CHECK(!placed.error().remedy.empty());
}
