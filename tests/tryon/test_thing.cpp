// Things from a mesh to proxy, files and report, compared with distances in closed form.
#include <doctest/doctest.h>

#include <cmath>
#include <set>

#include <nlohmann/json.hpp>

#include <bodice/io/obj.hpp>
#include <bodice/proxy/proxy_distance.hpp>
#include <bodice/proxy/proxy_file.hpp>
#include <bodice/proxy/proxy_surface.hpp>
#include <bodice/synth/thing.hpp>
#include <bodice/tryon/report.hpp>
#include <bodice/tryon/rigged_body.hpp>
#include <bodice_test/executors.hpp>
#include <bodice_test/temp_folder.hpp>

using namespace bodice;
using geometry::Vec3;
using synth::ThingKind;

namespace {

constexpr double kEdge_m = 0.02;

tryon::SegmentedSkin segmented(const geometry::TriMesh& mesh) {
  auto input = tryon::repair_body({}, mesh);
  REQUIRE_MESSAGE(input.ok(), input.error().sentence());
  input->shape = io::Shape::kAny;
  auto skin = tryon::segment_mesh({}, std::move(input).value(), {});
  REQUIRE_MESSAGE(skin.ok(), skin.error().sentence());
  return std::move(skin).value();
}

tryon::PreparedBody fitted(const engine::Context& context, const geometry::TriMesh& mesh,
                           const fitting::FitOptions& options) {
  auto thing = tryon::fit_proxy(context, segmented(mesh), options);
  REQUIRE_MESSAGE(thing.ok(), thing.error().sentence());
  return std::move(thing).value();
}

/// The mean distance from a surface to the thing, by the thing's own formula.
double distance_m(const geometry::TriMesh& surface, const synth::Thing& thing) {
  double sum = 0.0, area = 0.0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const double twice = area_vector(surface, t).norm();
    const Vec3 middle = (surface.corner(t, 0) + surface.corner(t, 1) + surface.corner(t, 2)) / 3.0;
    sum += twice * std::abs(thing.distance(middle));
    area += twice;
  }
  return sum / area;
}

/// How much farther the proxy's surface is from the thing than the mesh that it was fitted to.
double true_gap_m(const proxy::BodyProxy& proxy, const synth::Thing& thing) {
  const auto surface = proxy::proxy_surface({}, proxy, proxy.stature_m() / 150.0);
  REQUIRE(surface.ok());
  return distance_m(surface->mesh, thing) - distance_m(thing.mesh, thing);
}

}  // namespace

TEST_CASE("things are fitted in every tier with the reported accuracy, by their distances in closed form") {
  struct Row {
    ThingKind kind;
    proxy::Tier tier;
    double gap_m;
  };
  const Row rows[] = {
      {ThingKind::kDog, proxy::Tier::kRelief, 0.0008},   {ThingKind::kTorso, proxy::Tier::kRelief, 0.0005},
      {ThingKind::kJoined, proxy::Tier::kRelief, 0.002}, {ThingKind::kDog, proxy::Tier::kTight, 0.004},
      {ThingKind::kDog, proxy::Tier::kSolid, 0.02},      {ThingKind::kDog, proxy::Tier::kPaper, 0.03},
      {ThingKind::kCube, proxy::Tier::kRelief, 0.004}};
  for (const Row& row : rows) {
    CAPTURE(std::string(synth::name(row.kind)));
    CAPTURE(std::string(proxy::name(row.tier)));
    const synth::Thing thing = synth::make_thing({}, row.kind, kEdge_m);
    const tryon::PreparedBody body = fitted({}, thing.mesh, {.tier = row.tier});
    const double gap_m = true_gap_m(body.fit.proxy, thing);
    CHECK(gap_m < row.gap_m);
    CHECK(body.fit.accuracy.gap_m.mean < row.gap_m);
    if (row.tier == proxy::Tier::kSolid) {
      CHECK(body.fit.accuracy.interior_covered_percent > 99.0);
      CHECK(body.fit.accuracy.skin_outside_percent < 0.5);
    }
    std::set<body::Part> parts;
    for (const proxy::ProxyEllipsoid& e : body.fit.proxy.ellipsoids()) {
      CHECK(body::is_of_thing(e.part));
      parts.insert(e.part);
    }
    CHECK(parts.size() == body.fit.parts.size());
  }
}

TEST_CASE("the fit of a thing meets a target error, and a limit on its ellipsoids") {
  const synth::Thing dog = synth::make_thing({}, ThingKind::kDog, kEdge_m);
  const tryon::PreparedBody near = fitted({}, dog.mesh, {.target_error_m = 0.003});
  CHECK(near.fit.accuracy.gap_m.mean < 0.0036);
  for (const proxy::Tier tier :
       {proxy::Tier::kPaper, proxy::Tier::kSolid, proxy::Tier::kTight, proxy::Tier::kRelief}) {
    const tryon::PreparedBody few = fitted({}, dog.mesh, {.tier = tier, .max_ellipsoids = 4});
    CHECK(few.fit.proxy.ellipsoids().size() <= 4);
    CHECK_FALSE(few.fit.proxy.ellipsoids().empty());
  }
}

TEST_CASE("a thing's proxy has the same bits for any number of workers and through both files") {
  const synth::Thing chair = synth::make_thing({}, ThingKind::kChair, kEdge_m);
  const tryon::PreparedBody one = fitted({}, chair.mesh, {.tier = proxy::Tier::kSolid});
  const auto threads = bodice_test::make_threads(3);
  const tryon::PreparedBody three =
      fitted({.executor = threads.get()}, chair.mesh, {.tier = proxy::Tier::kSolid});
  CHECK(one.fit.proxy.hash() == three.fit.proxy.hash());
  CHECK(proxy::from_json(proxy::to_json(one.fit.proxy))->hash() == one.fit.proxy.hash());
  CHECK(proxy::from_binary(proxy::to_binary(one.fit.proxy))->hash() == one.fit.proxy.hash());
}

TEST_CASE("the report of a thing has its parts with boxes, its height, and no landmarks") {
  const bodice_test::TempFolder folder;
  const auto file = folder / "chair.obj";
  REQUIRE(io::write_obj(synth::make_thing({}, ThingKind::kChair, 0.03).mesh, file,
                        {.meters_per_unit = 0.01, .up = geometry::Axis::kZ})
              .ok());
  tryon::SegmentOptions options;
  options.import = {.shape = io::Shape::kAny, .unit = io::Unit::kCentimeter, .up = geometry::Axis::kZ};
  auto skin = tryon::segment_file({}, file, options);
  REQUIRE_MESSAGE(skin.ok(), skin.error().sentence());
  CHECK_FALSE(tryon::give_rig({}, tryon::BodyFile{file}, *skin).ok());
  const auto thing = tryon::fit_proxy({}, std::move(skin).value(), {.tier = proxy::Tier::kSolid});
  REQUIRE(thing.ok());
  const auto report = nlohmann::json::parse(tryon::report_json(*thing, nullptr, {}));
  CHECK(report["shape"] == "any");
  CHECK(report["height_m"].get<double>() == doctest::Approx(0.95).epsilon(1e-5));
  CHECK(report["landmarks"].empty());
  for (const auto& warning : report["warnings"]) CHECK(warning["code"] == "non-manifold-edges");
  double lowest = 1e9, highest = -1e9;
  for (const auto& part : report["parts"]) {
    CHECK(part["name"].get<std::string>().starts_with("part_"));
    const double z = part["center"][2], half = part["size"][2].get<double>() / 2.0;
    lowest = std::min(lowest, z - half);
    highest = std::max(highest, z + half);
  }
  CHECK(lowest == doctest::Approx(0.0).epsilon(1e-5));
  CHECK(highest == doctest::Approx(95.0).epsilon(1e-5));  // in the file's centimeters and axes
}
