// Parts of things that are no person, by surfaces with known limbs.
#include <doctest/doctest.h>

#include <cmath>
#include <set>

#include <bodice/anatomy/thing.hpp>
#include <bodice/geometry/mesh_repair.hpp>
#include <bodice/synth/thing.hpp>
#include <bodice_test/executors.hpp>

using namespace bodice;
using body::Part;
using geometry::Vec3;
using synth::ThingKind;

namespace {

geometry::TriMesh skin_of(ThingKind kind, double edge_m) {
  auto repaired = geometry::repair({}, synth::make_thing({}, kind, edge_m).mesh);
  REQUIRE(repaired.ok());
  return std::move(repaired->mesh);
}

anatomy::Anatomy analyzed_thing(const geometry::TriMesh& skin) {
  auto found = anatomy::analyze_thing({}, skin);
  REQUIRE_MESSAGE(found.ok(), found.error().sentence());
  REQUIRE(found->part.size() == skin.positions.size());
  return std::move(found).value();
}

/// The part at the vertex that is nearest to a point.
Part part_at(const geometry::TriMesh& skin, const anatomy::Anatomy& found, const Vec3& point) {
  std::size_t best = 0;
  for (std::size_t v = 0; v < skin.positions.size(); ++v)
    if ((skin.positions[v] - point).norm() < (skin.positions[best] - point).norm()) best = v;
  return found.part[best];
}

/// The number of different parts at points.
std::size_t parts_at(const geometry::TriMesh& skin, const anatomy::Anatomy& found,
                     const std::vector<Vec3>& points) {
  std::set<Part> parts;
  for (const Vec3& p : points) parts.insert(part_at(skin, found, p));
  return parts.size();
}

const std::vector<Vec3> kLegsAndBack = {
    {-0.2, 0.05, -0.2}, {0.2, 0.05, -0.2}, {-0.2, 0.05, 0.2}, {0.2, 0.05, 0.2}, {0.0, 0.95, -0.24}};

}  // namespace

TEST_CASE("each leg of a chair of boards is a part, and so is each loose piece of a thing") {
  const geometry::TriMesh skin = skin_of(ThingKind::kChair, 0.03);
  const anatomy::Anatomy found = analyzed_thing(skin);
  std::set<Part> of_leg[4];
  for (std::size_t v = 0; v < skin.positions.size(); ++v) {
    const Vec3& p = skin.positions[v];
    if (p.y() < 0.35) of_leg[(p.x() > 0.0 ? 1 : 0) + (p.z() > 0.0 ? 2 : 0)].insert(found.part[v]);
  }
  std::set<Part> all;
  for (const std::set<Part>& parts : of_leg) {
    CHECK(parts.size() == 1);
    all.insert(parts.begin(), parts.end());
  }
  CHECK(all.size() == 4);

  geometry::TriMesh pair = skin_of(ThingKind::kCube, 0.1);
  const std::size_t vertices = pair.positions.size(), triangles = pair.triangles.size();
  for (std::size_t v = 0; v < vertices; ++v)
    pair.positions.push_back(pair.positions[v] + Vec3(0.6, 0.0, 0.0));
  for (std::size_t t = 0; t < triangles; ++t) {
    geometry::Triangle moved = pair.triangles[t];
    for (geometry::Index& v : moved) v += static_cast<geometry::Index>(vertices);
    pair.triangles.push_back(moved);
  }
  const anatomy::Anatomy two = analyzed_thing(pair);
  for (std::size_t v = 0; v < vertices; ++v)
    for (std::size_t w = vertices; w < 2 * vertices; ++w) REQUIRE(two.part[v] != two.part[w]);
}

TEST_CASE("limbs of things in one skin are parts of their own") {
  SUBCASE("the legs and the back of a chair") {
    const geometry::TriMesh skin = skin_of(ThingKind::kJoined, 0.015);
    CHECK(parts_at(skin, analyzed_thing(skin), kLegsAndBack) == 5);
  }
  SUBCASE("the paws, the nose and the tail of a dog") {
    const geometry::TriMesh skin = skin_of(ThingKind::kDog, 0.015);
    const std::vector<Vec3> ends = {{-0.09, 0.0, -0.26}, {0.09, 0.0, -0.26}, {-0.09, 0.0, 0.26},
                                    {0.09, 0.0, 0.26},   {0.0, 0.74, 0.73},  {0.0, 0.72, -0.65}};
    CHECK(parts_at(skin, analyzed_thing(skin), ends) == 6);
  }
  SUBCASE("the fingers and the thumb of a hand") {
    const geometry::TriMesh skin = skin_of(ThingKind::kHand, 0.002);
    const std::vector<Vec3> tips = {{0.034, 0.16, 0.0},
                                    {0.0115, 0.17, 0.0},
                                    {-0.0115, 0.17, 0.0},
                                    {-0.034, 0.16, 0.0},
                                    {0.06, 0.075, 0.005}};
    CHECK(parts_at(skin, analyzed_thing(skin), tips) == 5);
  }
}

TEST_CASE("parts are numbered by falling area and known by name") {
  const geometry::TriMesh skin = skin_of(ThingKind::kDog, 0.02);
  const anatomy::Anatomy found = analyzed_thing(skin);
  std::vector<double> area(body::kAllPartCount, 0.0);
  for (std::size_t t = 0; t < skin.triangles.size(); ++t)
    for (const geometry::Index v : skin.triangles[t])
      area[static_cast<std::size_t>(found.part[v])] += area_vector(skin, t).norm();
  for (int p = 0; p < body::kPartCount; ++p) CHECK(area[static_cast<std::size_t>(p)] == 0.0);
  for (std::size_t p = body::kPartCount + 1; p < area.size(); ++p) CHECK(area[p] <= area[p - 1]);
  CHECK(body::name(body::thing_part(0)) == "part_1");
  CHECK(body::name(body::thing_part(body::kThingPartCount - 1)) == "part_16");
  for (int p = 0; p < body::kAllPartCount; ++p)
    CHECK(body::part_from_name(body::kPartNames[static_cast<std::size_t>(p)]) == static_cast<Part>(p));
}

TEST_CASE("the scale of a thing is that of a person with as much skin") {
  // A cube of half a meter has 1.5 m2; 1.65 is 1.70 m squared over 1.75 m2.
  CHECK(analyzed_thing(skin_of(ThingKind::kCube, 0.05)).stature_m == doctest::Approx(std::sqrt(1.65 * 1.5)));
  const auto person = synth::make_body({}, {.stature_m = 1.7, .mass_kg = 66.0});
  REQUIRE(person.ok());
  CHECK(analyzed_thing(person->mesh).stature_m == doctest::Approx(1.7).epsilon(0.06));
}

TEST_CASE("parts do not depend on size or workers, and the scale goes with the size") {
  const geometry::TriMesh skin = skin_of(ThingKind::kJoined, 0.02);
  const anatomy::Anatomy found = analyzed_thing(skin);
  geometry::TriMesh larger = skin;
  for (Vec3& p : larger.positions) p *= 1024.0;  // a power of two changes no digit
  const anatomy::Anatomy scaled = analyzed_thing(larger);
  CHECK(scaled.part == found.part);
  CHECK(scaled.stature_m == 1024.0 * found.stature_m);
  const auto threads = bodice_test::make_threads(3);
  const auto shared = anatomy::analyze_thing({.executor = threads.get()}, skin);
  REQUIRE(shared.ok());
  CHECK(shared->part == found.part);
}

TEST_CASE("no landmark of a thing is found, and a sheet is refused") {
  for (const body::Landmark& mark : analyzed_thing(skin_of(ThingKind::kCube, 0.1)).landmarks)
    CHECK(mark.confidence == 0.0);
  geometry::TriMesh sheet{{{0, 0, 5}, {1, 0, 5}, {1, 1, 5}, {0, 1, 5}}, {{0, 1, 2}, {0, 2, 3}}};
  const auto refused = anatomy::analyze_thing({}, sheet);
  REQUIRE_FALSE(refused.ok());
  CHECK(refused.error().code == engine::ErrorCode::kUnusableGeometry);
  CHECK(refused.error().message.find("sheet") != std::string::npos);
}

TEST_CASE("more loose pieces than there are parts share them") {
  geometry::TriMesh beads;
  for (int i = 0; i < 40; ++i) {
    geometry::TriMesh bead = synth::make_thing({}, ThingKind::kCube, 0.2).mesh;
    const auto first = static_cast<geometry::Index>(beads.positions.size());
    for (const Vec3& p : bead.positions) beads.positions.push_back(p + Vec3(0.6 * i, 0.0, 0.0));
    for (const geometry::Triangle& t : bead.triangles)
      beads.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  auto repaired = geometry::repair({}, beads);
  REQUIRE(repaired.ok());
  const anatomy::Anatomy found = analyzed_thing(repaired->mesh);
  CHECK(std::set<Part>(found.part.begin(), found.part.end()).size() == body::kThingPartCount);
  for (const Part part : found.part) CHECK(body::is_of_thing(part));
}
