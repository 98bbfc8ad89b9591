// Loose pieces of a garment stay where they lie on each other.
#include <doctest/doctest.h>

#include <algorithm>

#include <bodice/tryon/tack.hpp>
#include <bodice_test/executors.hpp>
#include <bodice_test/shapes.hpp>

using namespace bodice;
using geometry::Index;
using geometry::Vec3;

namespace {

/// Square cells of 2 cm in the plane z = depth, with a corner at (left, bottom).
void add_sheet(double left, double bottom, double depth, int across, int up, geometry::TriMesh& mesh) {
  constexpr double kCell_m = 0.02;
  const auto first = static_cast<Index>(mesh.positions.size());
  const auto at = [&](int i, int j) { return first + static_cast<Index>(j * (across + 1) + i); };
  for (int j = 0; j <= up; ++j)
    for (int i = 0; i <= across; ++i)
      mesh.positions.push_back(Vec3(left + kCell_m * i, bottom + kCell_m * j, depth));
  for (int j = 0; j < up; ++j)
    for (int i = 0; i < across; ++i) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
}

/// A sheet, a second one that overlaps its lower border by 3 cm and lies `apart_m` off, and a button in
/// front.
geometry::TriMesh bib_and_skirt(double apart_m) {
  geometry::TriMesh mesh;
  add_sheet(0.0, 1.0, 0.0, 20, 10, mesh);
  add_sheet(0.01, 0.83, apart_m, 19, 10, mesh);
  add_sheet(0.1, 1.1, 0.003, 1, 1, mesh);
  return mesh;
}

/// The lowest height of the vertices [first, last) after half a second of fall with the first row of the
/// first sheet pinned.
double lowest_after_fall(const geometry::TriMesh& mesh, std::span<const cloth::Tack> tacks, Index first,
                         Index last) {
  std::vector<Index> pinned;
  for (Index v = 0; v < mesh.positions.size(); ++v)
    if (mesh.positions[v].y() > 1.199) pinned.push_back(v);
  auto solver = cloth::Solver::make(mesh, pinned, cloth::find_fabric("cotton").value(),
                                    {.substeps = 16, .iterations = 2}, tacks);
  REQUIRE(solver.ok());
  for (int frame = 0; frame < 30; ++frame) solver->step({}, 1.0 / 60.0);
  std::vector<Vec3> at(mesh.positions.size());
  solver->positions(at);
  double lowest = 1e9;
  for (Index v = first; v < last; ++v) lowest = std::min(lowest, at[v].y());
  return lowest;
}

}  // namespace

TEST_CASE("tack: overlapping borders and small pieces are tacked, and reported by piece") {
  const geometry::TriMesh mesh = bib_and_skirt(0.004);
  const tryon::Tacking tacking = tryon::find_tacks({}, mesh, 0.006);
  REQUIRE(tacking.pieces.size() == 3);
  CHECK(tacking.pieces[0].piece == 1);
  CHECK(tacking.pieces[0].onto == 2);
  CHECK(tacking.pieces[1].piece == 2);
  CHECK(tacking.pieces[1].onto == 1);
  CHECK(tacking.pieces[1].points >= 20);  // the whole upper border
  CHECK(tacking.pieces[2].piece == 3);
  CHECK(tacking.pieces[2].points == 4);  // the button, at all of its vertices
  for (const cloth::Tack& tack : tacking.tacks)
    CHECK((mesh.positions[tack.a] - mesh.positions[tack.b]).norm() < 0.03);
}

TEST_CASE("tack: pieces farther apart than the distance, and a garment of one piece, get no tacks") {
  CHECK(tryon::find_tacks({}, bib_and_skirt(0.004), 0.002).tacks.empty());
  CHECK(tryon::find_tacks({}, bib_and_skirt(0.004), 0.0).tacks.empty());
  geometry::TriMesh one;
  add_sheet(0.0, 0.0, 0.0, 5, 5, one);
  CHECK(tryon::find_tacks({}, one, 0.1).tacks.empty());
}

TEST_CASE("tack: a bodice that a few triangles join to its skirt is tacked all around") {
  constexpr int kAround = 48;
  const auto dress = [](double gap_m, double aside_m) {  // they overlap by 3 cm
    geometry::TriMesh bodice = bodice_test::cylinder(0.15, 0.4, kAround, 20, false),
                      skirt = bodice_test::cylinder(0.15 + gap_m, 0.6, kAround, 30, false);
    for (Vec3& p : skirt.positions) p += Vec3(aside_m, -0.47, 0.0);
    geometry::TriMesh mesh = bodice_test::joined(bodice, skirt);
    mesh.triangles.push_back({1, 0, static_cast<Index>(mesh.positions.size()) - 1});
    return mesh;
  };
  const geometry::TriMesh mesh = dress(0.004, 0.0);
  const tryon::Tacking tacking = tryon::find_tacks({}, mesh, 0.006);
  REQUIRE(tacking.pieces.size() == 1);
  CHECK(tacking.pieces[0].piece == 1);
  CHECK(tacking.pieces[0].onto == 1);
  CHECK(tacking.pieces[0].points > 2 * kAround * 9 / 10);
  for (const cloth::Tack& tack : tacking.tacks)
    CHECK((mesh.positions[tack.a] - mesh.positions[tack.b]).norm() < 0.04);
  // A rim that touches another layer on one side alone is no seam.
  CHECK(tryon::find_tacks({}, dress(0.03, 0.027), 0.006).tacks.empty());
}

TEST_CASE("tack: the rim of a collar that is folded down is no seam") {
  // A tube, of which the upper third is folded outward and down over the rest.
  geometry::TriMesh mesh = bodice_test::cylinder(0.15, 0.6, 48, 60, false);
  for (Vec3& p : mesh.positions) {
    if (p.y() <= 0.1) continue;
    p = Vec3(p.x() * 0.154 / 0.15, 0.2 - p.y(), p.z() * 0.154 / 0.15);
  }
  CHECK(tryon::find_tacks({}, mesh, 0.006).tacks.empty());
}

TEST_CASE("tack: a border that touches another piece in a few points only is no seam") {
  geometry::TriMesh mesh;
  add_sheet(0.0, 1.0, 0.0, 20, 10, mesh);
  add_sheet(0.36, 0.83, 0.004, 19, 10, mesh);  // its corner lies on the corner of the first
  CHECK(tryon::find_tacks({}, mesh, 0.006).tacks.empty());
}

TEST_CASE("tack: without tacks a loose piece falls, with them it hangs where it lay") {
  const geometry::TriMesh mesh = bib_and_skirt(0.004);
  const auto skirt = static_cast<Index>(21 * 11), button = skirt + 20 * 11;
  const auto end = static_cast<Index>(mesh.positions.size());
  const tryon::Tacking tacking = tryon::find_tacks({}, mesh, 0.006);
  CHECK(lowest_after_fall(mesh, {}, skirt, button) < 0.83 - 0.5);
  CHECK(lowest_after_fall(mesh, tacking.tacks, skirt, button) > 0.83 - 0.03);
  CHECK(lowest_after_fall(mesh, tacking.tacks, button, end) > 1.1 - 0.02);
}

TEST_CASE("tack: the tacks are the same for any number of workers, and valid for a solver") {
  const geometry::TriMesh mesh = bib_and_skirt(0.004);
  const auto executor = bodice_test::make_threads(3);
  const tryon::Tacking one = tryon::find_tacks({}, mesh, 0.006),
                       many = tryon::find_tacks({.executor = executor.get()}, mesh, 0.006);
  REQUIRE(one.tacks.size() == many.tacks.size());
  for (std::size_t k = 0; k < one.tacks.size(); ++k)
    CHECK((one.tacks[k].a == many.tacks[k].a && one.tacks[k].b == many.tacks[k].b));
  const cloth::Tack strange[] = {{0, 0}, {0, 1u << 30}, {geometry::kNoIndex, 1}};
  CHECK(cloth::Solver::make(mesh, {}, cloth::find_fabric("cotton").value(), {}, strange).ok());
}
