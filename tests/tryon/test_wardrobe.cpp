// Garments in memory may be invalid: a reference to a missing vertex is an error, and is never read.

#include <doctest/doctest.h>

#include <limits>
#include <string>

#include <nlohmann/json.hpp>

#include <bodice/tryon/drape.hpp>
#include <bodice/tryon/reach.hpp>
#include <bodice/tryon/report.hpp>
#include <bodice/tryon/session.hpp>

using namespace bodice;

namespace {

/// A garment of one triangle in front of the chest.
tryon::WornGarment patch(std::string name) {
  tryon::WornGarment garment{.name = std::move(name)};
  garment.mesh.positions = {{-0.1, 1.2, 0.3}, {0.1, 1.2, 0.3}, {0.0, 1.3, 0.3}};
  garment.mesh.triangles = {{0, 1, 2}};
  return garment;
}

const tryon::PreparedBody& wearer() {
  static const tryon::PreparedBody made = [] {
    auto skin = tryon::segment_builtin({}, {.vertices = 1500}, {});
    REQUIRE(skin.ok());
    auto fitted = tryon::fit_proxy({}, std::move(skin).value(), {.tier = proxy::Tier::kPaper});
    REQUIRE(fitted.ok());
    return std::move(fitted).value();
  }();
  return made;
}

template <class T>
std::string why(const engine::Result<T>& result) {
  REQUIRE_FALSE(result.ok());
  CHECK(result.error().code == engine::ErrorCode::kInvalidArgument);
  return result.error().sentence();
}

bool holds(const std::string& text, std::initializer_list<const char*> words) {
  for (const char* word : words)
    if (text.find(word) == std::string::npos) return false;
  return true;
}

}  // namespace

TEST_CASE("wardrobe: garments are joined in order, each with its own vertices") {
  tryon::WornGarment first = patch("vest"), second = patch("scarf");
  second.held = {2};
  const auto all = tryon::join({first, second});
  REQUIRE(all.ok());
  CHECK(all->first_vertex == std::vector<std::size_t>{0, 3, 6});
  CHECK(all->held == std::vector<geometry::Index>{5});
  CHECK(all->mesh.triangles[1] == geometry::Triangle{3, 4, 5});
}

TEST_CASE("wardrobe: a reference to a missing vertex is an error that names the vertex, in every function") {
  tryon::WornGarment held = patch("vest"), torn = patch("");
  held.held = {3};  // would be the first vertex of the scarf
  torn.mesh.triangles.push_back({0, 1, 77});
  CHECK(holds(why(tryon::join({held, patch("scarf")})), {"vest", "vertex 3", "3 vertices"}));
  CHECK(holds(why(tryon::join({patch("scarf"), torn})), {"Garment 1", "triangle 1", "vertex 77"}));

  tryon::Session session({}, {});
  CHECK(holds(why(session.dress({held})), {"vest"}));
  CHECK(holds(why(tryon::drape({}, wearer(), {torn}, {})), {"triangle 1"}));
  CHECK(holds(why(tryon::reachable_parts({}, wearer().skin, {&torn.mesh, 1}, 0.05)), {"triangle 1"}));
  CHECK(holds(why(tryon::within_reach({}, wearer().fit.proxy, {&torn.mesh, 1}, 0.05)), {"triangle 1"}));
}

TEST_CASE("drape: options out of range are refused by name") {
  const std::vector<tryon::WornGarment> worn = {patch("vest")};
  const auto refused = [&](const tryon::DrapeOptions& options) {
    return why(tryon::drape({}, wearer(), worn, options));
  };
  for (const int frames : {0, -1}) CHECK(holds(refused({.frames = frames}), {"frames"}));
  for (const int kept : {1, 0, -5}) CHECK(holds(refused({.kept_frames = kept}), {"kept_frames"}));
  for (const double dt_s :
       {-0.1, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    CHECK(holds(refused({.dt_s = dt_s}), {"dt_s"}));
  const auto shortest = tryon::drape({}, wearer(), worn, {.frames = 1, .kept_frames = 2});
  REQUIRE(shortest.ok());
  CHECK(shortest->garments[0].frames.size() == 2);
}

TEST_CASE("drape: the given fabric is used, whatever its name") {
  const auto hash = [&](std::optional<cloth::Fabric> fabric) {
    const auto draped = tryon::drape({}, wearer(), {patch("vest")}, {.frames = 10, .fabric = fabric});
    REQUIRE(draped.ok());
    return draped->report.hash;
  };
  cloth::Fabric cotton = cloth::find_fabric("cotton").value();
  cloth::Fabric own = cloth::find_fabric("leather").value();
  cotton.name.clear(), own.name.clear();
  CHECK(hash(std::nullopt) == hash(cotton));
  CHECK(hash(std::nullopt) != hash(own));
}

TEST_CASE("drape: a garment that is nowhere near the body, or in other units, gives a warning") {
  const auto codes = [&](auto&& change) {
    tryon::WornGarment garment = patch("vest");
    for (geometry::Vec3& p : garment.mesh.positions) p = change(p);
    const auto draped = tryon::drape({}, wearer(), {garment}, {.frames = 1});
    REQUIRE(draped.ok());
    std::string all;
    for (const engine::Warning& w : draped->report.warnings) {
      all += w.code + " ";
      CHECK(w.part == "vest");
    }
    return all;
  };
  using geometry::Vec3;
  CHECK(codes([](const Vec3& p) { return p; }).empty());
  CHECK(codes([](const Vec3& p) { return Vec3(p + Vec3(3.0, 0.0, 0.0)); }) == "garment-far ");
  CHECK(codes([](const Vec3& p) { return Vec3(0.01 * p); }) == "garment-size ");  // meters for centimeters
  CHECK(codes([](const Vec3& p) { return Vec3(100.0 * (p - Vec3(0.0, 1.2, 0.3))); }) == "garment-size ");
}

TEST_CASE("report: it has the garments, and all that is needed to repeat the run") {
  tryon::WornGarment vest = patch("vest.obj");
  vest.held = {1, 2};
  const auto draped = tryon::drape({}, wearer(), {vest}, {.frames = 2, .dt_s = 0.01});
  REQUIRE(draped.ok());
  const tryon::RunInfo run{.threads = 2,
                           .seed = 5,
                           .program = "bodice 1",
                           .command = {"bodice", "drape", "a b.obj"},
                           .cropped = true};
  const auto report = nlohmann::json::parse(tryon::report_json(wearer(), &draped->report, run));
  CHECK(report["program"] == "bodice 1");
  CHECK(report["command"] == nlohmann::json{"bodice", "drape", "a b.obj"});
  CHECK(report["accuracy"].contains("of"));
  auto garments = report["drape"]["garments"];
  REQUIRE(garments.size() == 1);
  REQUIRE(garments[0]["ease"].size() == 1);  // one triangle lies on one part
  CHECK(garments[0]["ease"][0]["area_cm2"].get<double>() == doctest::Approx(100.0).epsilon(1e-3));
  garments[0].erase("ease");
  CHECK(garments ==
        nlohmann::json::parse(R"([{"name": "vest.obj", "vertices": 3, "held": 2, "tacked": []}])"));
  CHECK(report["drape"]["fabric"] == "cotton");
  CHECK(report["drape"]["dt_s"] == 0.01);
  CHECK(report["drape"]["substeps"] == tryon::DrapeOptions{}.solver.substeps);
  CHECK(report["stages"].back()["name"] == "drape");
  const auto plain = nlohmann::json::parse(tryon::report_json(wearer(), nullptr, {}));
  CHECK_FALSE(plain["accuracy"].contains("of"));
}

TEST_CASE("report: it is written although names are not UTF-8") {
  tryon::PreparedBody named = wearer();
  named.skin.input.file = "K\xF6rper.obj";
  named.skin.input.mesh = "K\xF6rper";
  CHECK(holds(tryon::report_json(named, nullptr, {}), {"rper.obj", "\"accuracy\""}));
}
