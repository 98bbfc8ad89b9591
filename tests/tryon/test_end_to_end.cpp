// All of preprocessing and draping on generated bodies: body -> parts -> proxy -> garment -> drape -> report.
// Every number in the report is compared with the known truth of the input.

#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include <nlohmann/json.hpp>

#include <bodice/io/obj.hpp>
#include <bodice/synth/body.hpp>
#include <bodice/synth/garment.hpp>
#include <bodice/tryon/reach.hpp>
#include <bodice/tryon/report.hpp>
#include <bodice/tryon/wearing.hpp>
#include <bodice_test/executors.hpp>
#include <bodice_test/temp_folder.hpp>

#include "builtin.hpp"

using namespace bodice;

namespace {

constexpr int kBodyVertices = 4500;

tryon::PreparedBody prepare(const engine::Context& context, proxy::Tier tier) {
  auto skin = tryon::segment_builtin(context, {.vertices = kBodyVertices}, {});
  REQUIRE_MESSAGE(skin.ok(), skin.error().sentence());
  auto body = tryon::fit_proxy(context, std::move(skin).value(), {.tier = tier});
  REQUIRE_MESSAGE(body.ok(), body.error().sentence());
  return std::move(body).value();
}

tryon::WornGarment skirt_for(const engine::Context& context, const tryon::SegmentedSkin& skin) {
  auto garment = tryon::make_garment(context, skin, {.kind = synth::GarmentKind::kSkirt});
  REQUIRE_MESSAGE(garment.ok(), garment.error().sentence());
  return std::move(garment).value();
}

}  // namespace

TEST_CASE("a generated body is measured, dressed and draped") {
  const auto executor = bodice_test::make_threads(2);
  const engine::Context context{.executor = executor.get()};
  const tryon::PreparedBody& body = builtin_body(kBodyVertices, proxy::Tier::kSolid);
  CHECK(body.skin.anatomy.stature_m == doctest::Approx(1.68).epsilon(0.02));
  CHECK(body.fit.accuracy.interior_covered_percent > 99.0);
  CHECK(body.fit.accuracy.gap_m.mean < 0.009);  // 6 mm; closing leaks must not make it twice as large

  const auto draped = tryon::drape(context, body, {skirt_for(context, body.skin)}, {.frames = 40});
  REQUIRE_MESSAGE(draped.ok(), draped.error().sentence());
  const tryon::DrapeReport& report = draped->report;
  CHECK(report.finite);
  CHECK(report.inside_union == 0);
  CHECK(report.penetration_over_1mm == 0);
  REQUIRE(draped->garments.size() == 1);
  CHECK(draped->garments[0].frames.size() == 31);

  // The skirt stays on: its center is between knees and waist.
  double height = 0.0;
  for (const geometry::Vec3& p : draped->garments[0].frames.back()) height += p.y();
  height /= static_cast<double>(draped->garments[0].frames.back().size());
  CHECK(height > 0.28 * 1.68);
  CHECK(height < 0.66 * 1.68);
}

TEST_CASE("tier solid: no ellipsoid lies far outside of the skin behind a hollow back") {
  // Fitted to samples of the skin alone, ellipsoids stand 92, 108, 286 and 145 mm out of these bodies.
  for (const std::uint64_t seed : {46, 97, 111, 133}) {
    CAPTURE(seed);
    auto skin = tryon::segment_builtin({}, {.vertices = 2000, .seed = seed}, {});
    REQUIRE_MESSAGE(skin.ok(), skin.error().sentence());
    const auto body = tryon::fit_proxy({}, std::move(skin).value(), {.tier = proxy::Tier::kSolid});
    REQUIRE_MESSAGE(body.ok(), body.error().sentence());
    CHECK(body->fit.accuracy.gap_m.max < 0.06);
    CHECK(body->fit.accuracy.interior_covered_percent == 100.0);
  }
}

TEST_CASE("a hole in the skin gives one warning") {
  auto made = synth::make_body({}, {.vertices = 3000});
  REQUIRE(made.ok());
  std::erase_if(made->mesh.triangles, [&](const geometry::Triangle& t) {
    return (made->mesh.positions[t[0]] - made->mesh.positions[100]).norm() < 0.03;
  });
  const bodice_test::TempFolder folder;
  const auto file = folder / "holed_body.obj";
  REQUIRE(io::write_obj(made->mesh, file).ok());
  const auto skin = tryon::segment_file({}, file, {});
  REQUIRE_MESSAGE(skin.ok(), skin.error().sentence());
  const auto warnings = std::ranges::count_if(skin->warnings, [](const engine::Warning& warning) {
    return warning.code == "holes" || warning.code == "open-edges";
  });
  CHECK(warnings == 1);
}

TEST_CASE("the same bits for any number of workers, from body to last frame") {
  std::vector<std::uint64_t> proxies, frames;
  for (const int workers : {1, 2, 3}) {
    const auto executor = bodice_test::make_threads(workers);
    const engine::Context context{.executor = executor.get()};
    const tryon::PreparedBody body = prepare(context, proxy::Tier::kSolid);
    const auto draped = tryon::drape(context, body, {skirt_for(context, body.skin)}, {.frames = 5});
    REQUIRE(draped.ok());
    proxies.push_back(body.fit.proxy.hash());
    frames.push_back(draped->report.hash);
  }
  for (std::size_t i = 1; i < proxies.size(); ++i) {
    CHECK(proxies[i] == proxies[0]);
    CHECK(frames[i] == frames[0]);
  }
}

TEST_CASE("only the parts that a garment can reach are fitted") {
  const engine::Context context;
  const tryon::SegmentedSkin& skin = builtin_skin(3000);
  const tryon::WornGarment skirt = skirt_for(context, skin);
  const std::uint32_t parts = tryon::reachable_parts(context, skin, std::span(&skirt.mesh, 1), 0.05).value();
  auto has = [&](body::Part part) { return (parts >> static_cast<int>(part) & 1u) != 0; };
  CHECK(has(body::Part::kThighL));
  CHECK(has(body::Part::kThighR));
  CHECK_FALSE(has(body::Part::kHead));

  const std::uint32_t wanted = parts;
  const auto body = tryon::fit_proxy(context, skin, {.tier = proxy::Tier::kPaper, .parts = wanted});
  REQUIRE(body.ok());
  // The six parts of the torso are one region: if one is reached, all are fitted as in the whole body.
  bool torso = false;
  for (int p = 0; p < body::kPartCount; ++p)
    torso = torso || (is_torso(static_cast<body::Part>(p)) && has(static_cast<body::Part>(p)));
  for (const proxy::ProxyEllipsoid& e : body->fit.proxy.ellipsoids())
    CHECK((has(e.part) || (torso && is_torso(e.part))));
}

TEST_CASE("the report has every key that its readers rely on") {
  const engine::Context context;
  const tryon::PreparedBody& body = builtin_body(kBodyVertices, proxy::Tier::kPaper);
  const auto draped = tryon::drape(context, body, {skirt_for(context, body.skin)}, {.frames = 2});
  REQUIRE(draped.ok());
  const auto report =
      nlohmann::json::parse(tryon::report_json(body, &draped->report, {.threads = 1, .seed = 3}));
  for (const char* key : {"input", "height_m", "tier", "threads", "seed", "hash", "ellipsoids", "bytes",
                          "mu_mm", "parts", "landmarks", "accuracy", "warnings", "stages", "drape"})
    CHECK_MESSAGE(report.contains(key), key);
  for (const char* key : {"/input/file",
                          "/input/mesh",
                          "/input/vertices",
                          "/input/triangles",
                          "/input/unit",
                          "/input/up",
                          "/input/welded",
                          "/input/dropped",
                          "/mu_mm/torso",
                          "/mu_mm/limbs",
                          "/parts/0/name",
                          "/parts/0/vertices",
                          "/parts/0/ellipsoids",
                          "/parts/0/radial_error_mm/mean",
                          "/parts/0/radial_error_mm/max",
                          "/parts/0/cluster_error_mm/mean",
                          "/parts/0/cluster_error_mm/max",
                          "/parts/0/gap_mm/mean",
                          "/parts/0/gap_mm/p95",
                          "/parts/0/gap_mm/max",
                          "/landmarks/0/name",
                          "/landmarks/0/position/2",
                          "/landmarks/0/confidence",
                          "/accuracy/gap_mm/mean",
                          "/accuracy/gap_mm/p95",
                          "/accuracy/gap_mm/max",
                          "/accuracy/interior_covered_percent",
                          "/accuracy/skin_outside_percent",
                          "/accuracy/skin_outside_depth_mm",
                          "/stages/0/name",
                          "/stages/0/ms",
                          "/drape/frames",
                          "/drape/particles",
                          "/drape/frame_ms/median",
                          "/drape/frame_ms/p99",
                          "/drape/frame_ms/max",
                          "/drape/penetration/count_over_1mm",
                          "/drape/penetration/max_mm",
                          "/drape/penetration/worst_frame",
                          "/drape/inside_union",
                          "/drape/garments/0/ease/0/part",
                          "/drape/garments/0/ease/0/area_cm2",
                          "/drape/garments/0/ease/0/gap_mm/median",
                          "/drape/garments/0/ease/0/gap_mm/p95",
                          "/drape/garments/0/ease/0/strain_percent/mean",
                          "/drape/garments/0/ease/0/strain_percent/p95",
                          "/drape/stretch/p95",
                          "/drape/stretch/max",
                          "/drape/median_speed_mm_s",
                          "/drape/finite"})
    CHECK_MESSAGE(report.contains(nlohmann::json::json_pointer(key)), key);
  CHECK(report["parts"].size() == body::kPartCount);
  CHECK(report["landmarks"].size() == body::kLandmarkCount);
  CHECK(report["seed"] == 3);
  CHECK(report["ellipsoids"] == body.fit.proxy.ellipsoids().size());
  CHECK(report["input"]["vertices"] == body.skin.input.skin.positions.size());
}

TEST_CASE("labels are one line a vertex, in the input's units") {
  tryon::SegmentedSkin skin = builtin_skin(3000);
  skin.input.frame = {.meters_per_unit = 0.01, .up = geometry::Axis::kZ};
  std::istringstream lines(tryon::labels_text(skin));
  std::size_t count = 0;
  double highest_z = 0.0, x = 0.0, y = 0.0, z = 0.0;
  std::string part;
  while (lines >> x >> y >> z >> part) {
    CHECK(body::part_from_name(part).has_value());
    highest_z = std::max(highest_z, z);
    ++count;
  }
  CHECK(count == skin.input.skin.positions.size());
  CHECK(highest_z == doctest::Approx(168.0).epsilon(0.03));
}

TEST_CASE("an ellipsoid carries the part of the skin that it stands for, wherever the fit moved it") {
  const tryon::PreparedBody& body = builtin_body(kBodyVertices, proxy::Tier::kTight);
  const geometry::TriMesh& mesh = body.skin.input.skin;
  int agree = 0;
  for (const proxy::ProxyEllipsoid& e : body.fit.proxy.ellipsoids()) {
    const geometry::SurfacePoint nearest = body.skin.distance->closest_point(e.shape.center);
    agree += body.skin.anatomy.part[mesh.triangles[nearest.triangle][0]] == e.part;
  }
  // Ellipsoids on a border may belong to either part.
  CHECK(agree > 0.8 * static_cast<double>(body.fit.proxy.ellipsoids().size()));
  for (const fitting::PartFit& part : body.fit.parts)
    CHECK_MESSAGE(part.ellipsoids > 0, body::name(part.part));
}

TEST_CASE("tier solid: very few ellipsoids enclose the parts and do not grow far beyond them") {
  auto skin = tryon::segment_builtin({}, {}, {});
  REQUIRE(skin.ok());
  const auto solid =
      fitting::fit({}, tryon::labeled(*skin), {.tier = proxy::Tier::kSolid, .max_ellipsoids = 8});
  REQUIRE(solid.ok());
  CHECK(solid->accuracy.gap_m.mean < 0.06);
  CHECK(solid->accuracy.skin_outside_depth_m <= 1e-9);
}

TEST_CASE("a garment that begins deep in a wide proxy is lifted out of it without tears or tangles") {
  // The back of this body is hollow at the waist, which the ellipsoids of the solid tier fill: 48 mm of them
  // cover the waistband.
  for (const proxy::Tier tier : {proxy::Tier::kSolid, proxy::Tier::kTight}) {
    CAPTURE(proxy::name(tier));
    auto skin = tryon::segment_builtin({}, {.vertices = 2000, .seed = 65}, {});
    REQUIRE(skin.ok());
    const auto body = tryon::fit_proxy({}, std::move(skin).value(), {.tier = tier});
    REQUIRE(body.ok());
    const auto draped = tryon::drape({}, *body, {skirt_for({}, body->skin)}, {.frames = 12});
    REQUIRE(draped.ok());
    const tryon::DrapeReport& report = draped->report;
    CHECK(report.crossings_end == 0);
    CHECK(report.stretch_p95 < 0.1);
    CHECK(report.stretch_max <
          3.0);  // one edge of the waistband; 60 and more where contact alone moves it out
    if (tier == proxy::Tier::kSolid)
      CHECK(report.lifted_m == doctest::Approx(0.06).epsilon(0.3));
    else
      CHECK(report.lifted_m == 0.0);
  }
}

TEST_CASE("a drape separates garments that cross before its first frame") {
  const tryon::PreparedBody& body = builtin_body(2000, proxy::Tier::kTight);
  const tryon::WornGarment skirt = skirt_for({}, body.skin);
  tryon::WornGarment over{.name = "over", .mesh = skirt.mesh, .held = skirt.held};
  for (geometry::Vec3& p : over.mesh.positions) {
    const double angle = std::atan2(p.z(), p.x());
    p += (0.001 + 0.003 * std::sin(5.0 * angle)) * geometry::Vec3(std::cos(angle), 0.0, std::sin(angle));
  }
  const auto draped = tryon::drape({}, body, {skirt, over}, {.frames = 1});
  REQUIRE(draped.ok());
  CHECK(draped->report.crossings_start > 100);
  CHECK(draped->report.crossings_separated == draped->report.crossings_start);
  CHECK(draped->report.crossings_end == 0);
}
