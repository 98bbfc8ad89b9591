// How garments fit: warnings of what is too small or too large, and colors by ease and strain.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include <bodice/synth/garment.hpp>
#include <bodice/tryon/drape.hpp>
#include <bodice/tryon/fit_map.hpp>
#include <bodice_test/executors.hpp>
#include <bodice_test/shapes.hpp>

#include "builtin.hpp"
#include "measure/fit_warnings.hpp"

using namespace bodice;
using geometry::Vec3;

namespace {

double lightness(const std::array<float, 3>& c) {
  return 0.2126 * double{c[0]} + 0.7152 * double{c[1]} + 0.0722 * double{c[2]};
}

/// A tube of cloth around the hips, above the crotch, with these radii across and in depth, relative to the
/// body's own half widths there; nothing holds it.
tryon::WornGarment tube_for(const tryon::PreparedBody& body, double of_body) {
  const double stature_m = body.skin.anatomy.stature_m;
  geometry::Box hips;
  for (std::size_t v = 0; v < body.skin.anatomy.part.size(); ++v) {
    const Vec3& p = body.skin.input.skin.positions[v];
    if ((body.skin.anatomy.part[v] == body::Part::kTorsoLL ||
         body.skin.anatomy.part[v] == body::Part::kTorsoLR) &&
        std::abs(p.y() - 0.52 * stature_m) < 0.02 * stature_m)
      hips.extend(p);
  }
  REQUIRE(!hips.empty());
  tryon::WornGarment tube{
      .name = "tube", .mesh = bodice_test::cylinder(1.0, 0.08 * stature_m, 48, 9, false), .held = {}};
  geometry::Box own = geometry::bounding_box(tube.mesh.positions);
  for (Vec3& p : tube.mesh.positions) {
    p.x() *= of_body * 0.5 * hips.size().x(), p.z() *= of_body * 0.5 * hips.size().z();
    p += Vec3(hips.center().x(), 0.5 * stature_m - own.low.y(), hips.center().z());
  }
  return tube;
}

std::vector<std::string> codes_of(const tryon::DrapeReport& report) {
  std::vector<std::string> codes;
  for (const engine::Warning& w : report.warnings) codes.push_back(w.code);
  return codes;
}

bool has(const std::vector<std::string>& codes, const char* code) {
  return std::ranges::find(codes, code) != codes.end();
}

/// The length that a garment lacks around a part, millimeters; 0 where the part has too little cloth to
/// judge.
double lacks_mm(const tryon::PartEase& part, const cloth::Fabric& fabric) {
  return part.area_m2 < 0.01 ? 0.0 : 1e3 * (part.strain_mean - fabric.max_stretch) * part.girth_m;
}

/// Whether the message names the part together with this length, rounded to millimeters.
bool names_part(const std::string& message, body::Part part, double mm) {
  const std::string name(body::name(part)), length = std::to_string(std::lround(mm)) + " mm";
  return message.find("around " + name + " it lacks " + length) != std::string::npos ||
         message.find(name + " (" + length + ")") != std::string::npos;
}

}  // namespace

TEST_CASE("fit map: colors run from dark blue over pale yellow to dark red, and stay beyond the ends") {
  const double values[] = {-0.01, 0.0, 0.025, 0.05, 0.3, std::nan("")};
  const auto colors = tryon::fit_colors(values, {tryon::FitMap::kEase, 0.05, 0.0});
  CHECK(colors[0] == colors[1]);
  CHECK(colors[3] == colors[4]);
  CHECK(colors[1][0] > 2.0f * colors[1][2]);  // red
  CHECK(colors[3][2] > 2.0f * colors[3][0]);  // blue
  CHECK(lightness(colors[2]) > 0.8);
  for (const auto& c : colors)
    for (const float channel : c) CHECK((channel >= 0.0f && channel <= 1.0f));
}

TEST_CASE("fit map: the ease of a vertex is its distance to the skin, the strain that of its triangles") {
  const geometry::TriMesh ball = bodice_test::icosphere(0.2, 4);
  const geometry::MeshDistance skin({}, ball);
  std::vector<Vec3> now = ball.positions;
  for (Vec3& p : now) p *= 1.05;
  now[7] = Vec3::Constant(std::nan(""));
  const std::vector<double> ease = tryon::ease_of_vertices({}, skin, now);
  CHECK(ease[7] == 0.0);
  for (std::size_t v = 0; v < now.size(); ++v)
    if (v != 7) CHECK(ease[v] == doctest::Approx(0.01).epsilon(0.02));
  for (Vec3& p : now = ball.positions) p *= 1.05;
  for (const double strain : tryon::strain_of_vertices(ball, now)) CHECK(strain == doctest::Approx(0.05));
  for (Vec3& p : now) p *= 0.9;
  for (const double strain : tryon::strain_of_vertices(ball, now)) CHECK(strain == 0.0);
}

TEST_CASE("fit: too-tight names each part that is at least 1 cm too tight, the tightest part first") {
  const auto cotton = cloth::find_fabric("cotton");
  REQUIRE(cotton.ok());
  REQUIRE(cotton->max_stretch == 0.04);
  using enum body::Part;
  const std::vector<tryon::PartEase> end = {
      {.part = kForearmL, .area_m2 = 0.02, .strain_mean = 0.14, .girth_m = 0.2},   // lacks 20 mm
      {.part = kThighL, .area_m2 = 0.03, .strain_mean = 0.09, .girth_m = 0.6},     // lacks 30 mm
      {.part = kUpperArmL, .area_m2 = 0.03, .strain_mean = 0.07, .girth_m = 0.3},  // lacks 9 mm
      {.part = kCalfL, .area_m2 = 0.005, .strain_mean = 0.2, .girth_m = 0.4},      // has too little cloth
      {.part = kCalfR, .area_m2 = 0.02, .strain_mean = 0.08, .girth_m = 0.35}};    // lacks 14 mm
  const tryon::WornGarment garment{.name = "suit"};
  const Vec3 up = Vec3::UnitY();
  std::vector<engine::Warning> warnings;
  tryon::warn_of_fit({garment, {}, end, {}, up, false}, *cotton, warnings);
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0].code == "too-tight");
  CHECK(warnings[0].part == "suit");
  CHECK(warnings[0].message ==
        "The garment is too tight: around thigh_l it lacks 30 mm (stretched by 9 %, cotton yields by 4 %); "
        "also around forearm_l (20 mm), calf_r (14 mm).");
  tryon::warn_of_fit({garment, {}, std::span(end).subspan(1, 1), {}, up, false}, *cotton, warnings);
  REQUIRE(warnings.size() == 2);
  CHECK(warnings[1].message ==
        "The garment is too tight: around thigh_l it lacks 30 mm (stretched by 9 %, cotton yields by 4 %).");
}

TEST_CASE("fit: cloth that a moving body has stretched beyond any size is caught, not too tight") {
  const auto cotton = cloth::find_fabric("cotton");
  REQUIRE(cotton.ok());
  using enum body::Part;
  const std::vector<tryon::PartEase> end = {
      {.part = kThighL, .area_m2 = 0.03, .strain_mean = 0.09, .girth_m = 0.6},
      {.part = kHead, .area_m2 = 0.03, .strain_mean = 0.51, .girth_m = 0.7},
      {.part = kUpperArmR, .area_m2 = 0.02, .strain_mean = 5.92, .girth_m = 0.3}};
  const tryon::WornGarment garment{.name = "shirt"};
  const Vec3 up = Vec3::UnitY();
  std::vector<engine::Warning> moved, stood;
  tryon::warn_of_fit({garment, {}, end, {}, up, false}, *cotton, moved);
  REQUIRE(moved.size() == 2);
  CHECK(moved[0].code == "too-tight");
  CHECK(moved[0].message ==
        "The garment is too tight: around thigh_l it lacks 30 mm (stretched by 9 %, cotton yields by 4 %).");
  CHECK(moved[1].code == "caught");
  CHECK(moved[1].part == "shirt");
  CHECK(moved[1].message ==
        "The cloth is caught at upper_arm_r, where it is stretched by 592 %; also at head (51 %).");
  // On a body that stands the same garment is much too small.
  const std::vector<geometry::Vec3> nothing;
  tryon::warn_of_fit({garment, {}, end, nothing, up, true}, *cotton, stood);
  REQUIRE(!stood.empty());
  CHECK(stood[0].code == "too-tight");
  for (const engine::Warning& w : stood) CHECK(w.code != "caught");
}

TEST_CASE("fit: a tube too small around the hips is too tight there by what it lacks, one that fits is not") {
  const auto executor = bodice_test::make_threads(2);
  const engine::Context context{.executor = executor.get()};
  const tryon::PreparedBody& body = builtin_body(4500, proxy::Tier::kSolid);
  const auto small =
      tryon::drape(context, body, {tube_for(body, 0.85)}, {.frames = 10, .fit_map = tryon::FitMap::kStrain});
  REQUIRE(small.ok());
  const auto tight = std::ranges::find(small->report.warnings, "too-tight", &engine::Warning::code);
  REQUIRE(tight != small->report.warnings.end());
  CHECK(tight->part == "tube");
  const auto cotton = cloth::find_fabric("cotton");
  REQUIRE(cotton.ok());
  CAPTURE(tight->message);
  std::vector<body::Part> named;
  for (const tryon::PartEase& part : small->report.garments[0].ease) {
    const double mm = lacks_mm(part, *cotton);
    CAPTURE(body::name(part.part));
    CHECK(names_part(tight->message, part.part, mm) == (mm >= 10.0));
    if (mm >= 10.0) named.push_back(part.part);
  }
  // The tube lies around the lower trunk.
  for (const body::Part hip : {body::Part::kTorsoLL, body::Part::kTorsoLR})
    CHECK(std::ranges::find(named, hip) != named.end());
  REQUIRE(small->garments[0].colors.size() == small->garments[0].mesh.positions.size());
  CHECK(small->report.fit_map->tight > 0.0);

  const auto fitting = tryon::drape(context, body, {tube_for(body, 1.35)}, {.frames = 30});
  REQUIRE(fitting.ok());
  CHECK(!has(codes_of(fitting->report), "too-tight"));
  CHECK(fitting->garments[0].colors.empty());
}

TEST_CASE("fit: a tube that nothing holds is too loose when it slides down, not while it lies") {
  const auto executor = bodice_test::make_threads(2);
  const engine::Context context{.executor = executor.get()};
  const tryon::PreparedBody& body = builtin_body(4500, proxy::Tier::kSolid);
  const tryon::WornGarment loose = tube_for(body, 1.3);
  const auto fallen = tryon::drape(context, body, {loose}, {.frames = 60});
  REQUIRE(fallen.ok());
  CHECK(has(codes_of(fallen->report), "too-loose"));
  const auto at_first = tryon::drape(context, body, {loose}, {.frames = 2});
  REQUIRE(at_first.ok());
  CHECK(!has(codes_of(at_first->report), "too-loose"));
}
