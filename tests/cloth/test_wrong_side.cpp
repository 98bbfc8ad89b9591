// Which particles and edges may pass other layers around triangles that cross, and which may not.
#include <doctest/doctest.h>

#include <numeric>

#include "layer_fixtures.hpp"
#include "selfcontact/loose.hpp"
#include "selfcontact/self_contact.hpp"
#include "selfcontact/tangles.hpp"

using namespace bodice;
using namespace bodice_test;

namespace {

/// All triangles that cross, by brute force.
std::vector<cloth::Tangle> tangles_of(const TriMesh& mesh, const cloth::ContactMesh& contact) {
  const auto face_of = [&](std::size_t triangle) {
    const auto same = [&](const cloth::Face& f) {
      return std::ranges::equal(f.particle, mesh.triangles[triangle]);
    };
    return static_cast<std::uint32_t>(std::ranges::find_if(contact.faces, same) - contact.faces.begin());
  };
  std::vector<cloth::Tangle> tangles;
  for (const auto& [s, t] : geometry::find_crossings(mesh.positions, mesh.triangles)) {
    const auto a = face_of(s), b = face_of(t);
    REQUIRE(std::max(a, b) < contact.faces.size());
    tangles.push_back({std::min(a, b), std::max(a, b)});
  }
  std::ranges::sort(tangles);
  return tangles;
}

/// A flat sheet of 12 x 12 quads of 5 cm with a second surface above it, 2 cm higher at rest and shifted, so
/// that no vertex is above another one. Vertices of either come first and second in `mesh`.
struct CrossedSheets {
  static constexpr int kQuads = 12;
  static constexpr double kEdge_m = 0.05, kApart_m = 0.02;
  TriMesh mesh;
  cloth::ContactMesh contact;
  cloth::Loose loose;
  std::vector<cloth::Tangle> tangles;

  explicit CrossedSheets(const std::function<double(const Vec3&)>& height_m) {
    auto add = [&](Vec3 from, const std::function<double(const Vec3&)>& height) {
      append(surface(kQuads, kQuads, false,
                     [&](double u, double v) {
                       Vec3 p = from + kQuads * kEdge_m * Vec3(u, 0, v);
                       p.y() = height(p);
                       return p;
                     }),
             mesh);
    };
    add(Vec3(0.013, 0, 0.017), [](const Vec3&) { return 0.0; });
    add(Vec3::Zero(), height_m);
    contact = cloth::make_contact_mesh(mesh);
    loose = cloth::make_loose(mesh.positions.size());
    tangles = tangles_of(mesh, contact);
    cloth::loosen(contact, tangles, points_of(mesh.positions), loose);
  }

  /// The vertex of the upper surface in a column and a row.
  Index upper(int column, int row) const {
    return static_cast<Index>(mesh.positions.size() / 2 +
                              static_cast<std::size_t>(row * (kQuads + 1) + column));
  }
  bool is_upper(Index i) const { return i >= mesh.positions.size() / 2; }

  std::vector<Index> passing() const {
    std::vector<Index> out;
    for (Index i = 0; i < mesh.positions.size(); ++i)
      if (loose.may_pass[i]) out.push_back(i);
    return out;
  }

  /// Whether contact does not act between a vertex and a triangle of the other surface, for all triangles
  /// that cross something.
  bool is_loose_with_tangles(Index vertex) const {
    bool any = false, all = true;
    for (const cloth::Tangle& t : tangles)
      for (const std::uint32_t f : {t.a, t.b}) {
        const Index(&p)[3] = contact.faces[f].particle;
        if (is_upper(p[0]) == is_upper(vertex)) continue;
        const bool loose_pair = cloth::are_loose({vertex, p[0], p[1], p[2]}, false, loose);
        any = any || loose_pair, all = all && loose_pair;
      }
    CHECK(any == all);
    return any;
  }
};

double distance_xz(const Vec3& p, const Vec3& q) {
  return std::hypot(p.x() - q.x(), p.z() - q.z());
}

/// The upper surface with its middle vertex, or all within a radius, pushed below the lower one.
CrossedSheets poked(double radius_m) {
  const Vec3 middle = 6 * CrossedSheets::kEdge_m * Vec3(1, 0, 1);
  return CrossedSheets([=](const Vec3& p) {
    return distance_xz(p, middle) < radius_m ? -0.5 * CrossedSheets::kApart_m : CrossedSheets::kApart_m;
  });
}

}  // namespace

TEST_CASE("wrong side: a particle that was pushed through a layer may return, and no other may pass") {
  const CrossedSheets sheets = poked(0.01);
  REQUIRE(sheets.tangles.size() > 3);
  const Index through = sheets.upper(6, 6), beside = sheets.upper(7, 6);
  CHECK(sheets.passing() == std::vector<Index>{through});
  CHECK(sheets.is_loose_with_tangles(through));
  CHECK(!sheets.is_loose_with_tangles(beside));
  REQUIRE(sheets.loose.is_corner[beside]);  // although it is a corner of a triangle that crosses another
}

TEST_CASE("wrong side: edges that pass through triangles may pass edges, and edges beside them may not") {
  const CrossedSheets sheets = poked(0.01);
  const Index through = sheets.upper(6, 6), beside = sheets.upper(7, 6), next = sheets.upper(6, 7);
  int through_pairs = 0, held_pairs = 0;
  for (const cloth::Tangle& t : sheets.tangles)
    for (const std::uint32_t f : {t.a, t.b}) {
      const Index(&p)[3] = sheets.contact.faces[f].particle;
      if (sheets.is_upper(p[0])) continue;
      CHECK(cloth::are_loose({through, beside, p[0], p[1]}, true, sheets.loose));
      ++through_pairs;
      if (!cloth::piercings_of(sheets.loose.parts, cloth::ends_of(p[0], p[1])).empty()) continue;
      CHECK(!cloth::are_loose({beside, next, p[0], p[1]}, true, sheets.loose));
      ++held_pairs;
    }
  CHECK(through_pairs > 0);
  CHECK(held_pairs > 0);
}

TEST_CASE("wrong side: all particles of a part that a line of crossing encloses may return") {
  const CrossedSheets sheets = poked(0.11);
  std::vector<Index> below;
  for (Index i = 0; i < sheets.mesh.positions.size(); ++i)
    if (sheets.is_upper(i) && sheets.mesh.positions[i].y() < 0.0) below.push_back(i);
  REQUIRE(below.size() == 13);
  for (const Index i : below) CHECK(sheets.loose.may_pass[i] != 0);
  for (const Index i : sheets.passing()) {
    CAPTURE(i);
    // The lower surface has a part inside the line, too, which is on the wrong side of the upper one.
    CHECK((!sheets.is_upper(i) || sheets.mesh.positions[i].y() < 0.0));
  }
}

TEST_CASE("wrong side: a corner of a border below another layer may return, and that layer may not pass") {
  const Vec3 corner = CrossedSheets::kQuads * CrossedSheets::kEdge_m * Vec3(1, 0, 1);
  const CrossedSheets sheets([&](const Vec3& p) {
    return distance_xz(p, corner) < 0.08 ? -CrossedSheets::kApart_m : CrossedSheets::kApart_m;
  });
  // The line of crossing ends inside the lower layer, so that it encloses no part of it.
  const auto lower_is_cut = [&](const cloth::EdgeEnds& cut) { return !sheets.is_upper(cut.p); };
  REQUIRE(std::ranges::any_of(sheets.loose.parts.cut, lower_is_cut));
  std::vector<Index> below;
  for (const int row : {11, 12})
    for (const int column : {11, 12}) below.push_back(sheets.upper(column, row));
  CHECK(sheets.passing() == below);
}

TEST_CASE("wrong side: where a layer passes right through another one, all at the line may pass") {
  const CrossedSheets sheets([](const Vec3& p) { return 0.3 * (p.x() - 0.31); });
  REQUIRE(sheets.tangles.size() > 10);
  for (const cloth::Tangle& t : sheets.tangles)
    for (const std::uint32_t f : {t.a, t.b})
      for (const Index i : sheets.contact.faces[f].particle) CHECK(sheets.loose.may_pass[i] != 0);
}

TEST_CASE("wrong side: a strip that is folded through itself beside its fold may come apart") {
  // The second half lies on the first one, turned a little too far at one border.
  TriMesh strip = folded_strip(std::numbers::pi - 0.05);
  const cloth::ContactMesh contact = cloth::make_contact_mesh(strip);
  const Index last = static_cast<Index>(strip.positions.size() - 1);
  strip.positions[last].y() = -0.05;
  const std::vector<cloth::Tangle> tangles = tangles_of(strip, contact);
  REQUIRE(!tangles.empty());
  cloth::Loose loose = cloth::make_loose(strip.positions.size());
  cloth::loosen(contact, tangles, points_of(strip.positions), loose);
  CHECK(loose.may_pass[last] != 0);
}

TEST_CASE("wrong side: a line of crossing that ends at a fold encloses a part up to the fold") {
  // A surface folded in the middle, its second half above the first one but for three vertices of a column
  // from the fold on. No vertex of a half is above one of the other.
  constexpr int kColumns = 12, kRows = 24, kFold = 12, kColumn = 6;
  const auto index = [](int column, int row) { return static_cast<Index>(row * (kColumns + 1) + column); };
  TriMesh mesh = surface(kColumns, kRows, false, [](double u, double v) {
    const double out = std::abs(v - 0.5);
    return v > 0.5 ? Vec3(u + 0.07 * out, 0.02, -0.93 * out) : Vec3(u, 0, -out);
  });
  for (int row = kFold + 1; row <= kFold + 3; ++row) mesh.positions[index(kColumn, row)].y() = -0.02;
  const cloth::ContactMesh contact = cloth::make_contact_mesh(mesh);
  cloth::Loose loose = cloth::make_loose(mesh.positions.size());
  const std::vector<cloth::Tangle> tangles = tangles_of(mesh, contact);
  REQUIRE(!tangles.empty());
  cloth::loosen(contact, tangles, points_of(mesh.positions), loose);
  REQUIRE(!loose.parts.line_ends.empty());
  for (int row = kFold + 1; row <= kFold + 3; ++row) {
    CAPTURE(row);
    CHECK(loose.may_pass[index(kColumn, row)] != 0);
    for (const int beside : {kColumn - 1, kColumn + 1}) CHECK(loose.may_pass[index(beside, row)] == 0);
  }
}

TEST_CASE("wrong side: a particle that is through a layer is drawn back where both lie on the body") {
  const CrossedSheets sheets = poked(0.01);
  const std::vector<std::uint8_t> on_body(sheets.mesh.positions.size(), 1);
  std::vector<cloth::Point> at = points_of(sheets.mesh.positions), room(at.size());
  for (cloth::Point& p : at) p.weight = 1.0f;
  const Index through = sheets.upper(6, 6);
  const float before = at[through].y;
  const std::vector<float> inverse_mass(at.size(), 1.0f);
  cloth::untangle(sheets.contact, sheets.tangles, {on_body, inverse_mass, sheets.loose, 1e-3f}, room, at);
  CHECK(at[through].y > before);
}

TEST_CASE(
    "wrong side: no particle follows one that is through a layer when layers are thrown at each other") {
  const CrossedSheets sheets = poked(0.01);
  std::vector<Index> pins(sheets.mesh.positions.size() / 2);
  std::iota(pins.begin(), pins.end(), Index{0});
  cloth::Solver solver = make_solver(sheets.mesh, pins, cotton(), layered(true));
  solver.set_velocity(Vec3(0, -3.0, 0));
  const collision::Collider far_away = ellipsoid_body(Vec3(0, -5.0, 0), Vec3::Constant(0.1));
  std::vector<Vec3> at = sheets.mesh.positions;
  for (int frame = 0; frame < 40; ++frame) {
    solver.step({}, far_away, kFrame_s);
    at = positions(solver, at.size());
    for (Index i = pins.size(); i < at.size(); ++i) {
      CAPTURE(frame);
      CAPTURE(i);
      // Beside the pinned layer nothing holds the other one.
      const bool above = at[i].x() > at.front().x() && at[i].z() > at.front().z();
      if (above && i != sheets.upper(6, 6)) CHECK(at[i].y() > 0.0);
    }
  }
  CHECK(crossings(sheets.mesh, sheets.mesh.positions) > 0);
  CHECK(crossings(sheets.mesh, at) == 0);
}
