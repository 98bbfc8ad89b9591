#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include <bodice/engine/random.hpp>
#include <bodice/geometry/mesh_repair.hpp>
#include <bodice_test/data.hpp>
#include <bodice_test/extremes.hpp>
#include <bodice_test/read_mesh.hpp>
#include <bodice_test/shapes.hpp>

using namespace bodice::geometry;
using namespace bodice_test;
using bodice::engine::Context;
using bodice::engine::ErrorCode;
using bodice::engine::Random;

namespace {

RepairedMesh repaired(const TriMesh& mesh) {
  auto result = repair(Context{}, mesh);
  REQUIRE(result.ok());
  return std::move(result).value();
}

/// Checks what holds for every repaired mesh, whatever the input.
void check_promises(const TriMesh& input, const RepairedMesh& got) {
  const TriMesh& mesh = got.mesh;
  REQUIRE(got.vertex_of_input.size() == input.positions.size());
  REQUIRE(got.triangle_of_input.size() == input.triangles.size());
  Index next = 0;  // vertices are numbered by first use; a turned triangle may swap its last two
  for (std::size_t t = 0; t < input.triangles.size(); ++t) {
    const Index kept = got.triangle_of_input[t];
    if (kept == kNoIndex) continue;
    REQUIRE(kept < mesh.triangles.size());
    Triangle expected;
    for (int k = 0; k < 3; ++k) expected[k] = got.vertex_of_input[input.triangles[t][k]];
    for (Index v : expected) {
      CHECK(v <= next);
      next = std::max(next, v + 1);
    }
    Triangle turned = expected;
    std::swap(turned[1], turned[2]);
    CHECK((mesh.triangles[kept] == expected || mesh.triangles[kept] == turned));
  }
  CHECK(next == mesh.positions.size());
  for (const Vec3& p : mesh.positions) CHECK(p.allFinite());
  std::vector<Triangle> sorted = mesh.triangles;
  for (Triangle& t : sorted) {
    std::sort(t.begin(), t.end());
    CHECK((t[0] != t[1] && t[1] != t[2]));
  }
  std::sort(sorted.begin(), sorted.end());
  CHECK(std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end());
  const auto dropped = std::count(got.vertex_of_input.begin(), got.vertex_of_input.end(), kNoIndex);
  CHECK(got.report.dropped_vertices == static_cast<std::size_t>(dropped));
  CHECK(got.report.dropped_triangles == input.triangles.size() - mesh.triangles.size());
  CHECK(got.report.components == connected_components(mesh).area.size());
}

}  // namespace

TEST_CASE("a clean mesh passes through unchanged") {
  for (const TriMesh& mesh : {box({1, 2, 3}, 3), torus(1.0, 0.3, 24, 12)}) {
    const RepairedMesh got = repaired(mesh);
    check_promises(mesh, got);
    CHECK(got.report.flipped_triangles == 0);
    CHECK(got.report.dropped_triangles == 0);
    CHECK(got.report.warnings.empty());
    CHECK(signed_volume(got.mesh) == doctest::Approx(signed_volume(mesh)).epsilon(1e-14));
  }
}

TEST_CASE("a soup with float noise welds back to the closed surface, at any scale and position") {
  const TriMesh clean = torus(1.0, 0.3, 24, 12);
  for (const auto& [scale, offset] :
       {std::pair{1.0, 0.0}, {1e-6, 0.0}, {1e6, 0.0}, {1.0, 1e4}, {1e-3, 1e4}}) {
    CAPTURE(scale);
    CAPTURE(offset);
    TriMesh noisy = moved(soup(clean), scale, Vec3::Constant(offset));
    Random random(9);
    for (Vec3& p : noisy.positions)
      for (int k = 0; k < 3; ++k) p[k] += 2e-7 * scale * random.uniform(-1.0, 1.0);
    const RepairedMesh got = repaired(noisy);
    check_promises(noisy, got);
    CHECK(got.mesh.positions.size() == clean.positions.size());
    CHECK(got.report.welded == noisy.positions.size() - clean.positions.size());
    CHECK(got.report.boundary_edges == 0);
    CHECK(got.report.euler_characteristic == 0);
    CHECK(signed_volume(got.mesh) / (scale * scale * scale) ==
          doctest::Approx(signed_volume(clean)).epsilon(1e-4));
  }
}

TEST_CASE("a stray vertex or component far away does not widen the weld distance") {
  const TriMesh clean = icosphere(1.0, 4);  // edges of 0.07
  TriMesh stray = joined(clean, icosphere(1.0, 0, {1e6, 0, 0}));
  CHECK(repaired(stray).mesh.positions.size() == stray.positions.size());
  TriMesh spiked = clean;
  spiked.positions.emplace_back(1e9, 0, 0);
  spiked.triangles.push_back({0, 1, static_cast<Index>(spiked.positions.size() - 1)});
  CHECK(repaired(spiked).mesh.positions.size() == spiked.positions.size());
}

TEST_CASE("any random set of reversed triangles is turned back, in every component") {
  const TriMesh clean =
      joined(icosphere(1.0, 3), joined(torus(0.5, 0.1, 20, 8), icosphere(0.2, 1, {4, 0, 0})));
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    TriMesh mixed = clean;
    Random random(seed);
    std::size_t reversed = 0;
    for (Triangle& t : mixed.triangles)
      if (random.uniform() < 0.3) {
        std::swap(t[1], t[2]);
        ++reversed;
      }
    const RepairedMesh got = repaired(mixed);
    check_promises(mixed, got);
    CHECK(got.report.flipped_triangles == reversed);
    CHECK(signed_volume(got.mesh) == doctest::Approx(signed_volume(clean)).epsilon(1e-12));
  }
}

TEST_CASE(
    "an open sheet keeps the winding of its majority, and without the option orient no triangle is turned") {
  TriMesh mesh = sheet(1.0, 1.0, 6, 6);
  std::swap(mesh.triangles[3][1], mesh.triangles[3][2]);
  CHECK(repaired(mesh).report.flipped_triangles == 1);
  auto untouched = repair(Context{}, mesh, {.orient = false});
  REQUIRE(untouched.ok());
  CHECK(untouched->report.flipped_triangles == 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k)
      CHECK(untouched->mesh.triangles[t][k] == untouched->vertex_of_input[mesh.triangles[t][k]]);
}

TEST_CASE("a Moebius band is reported, not looped over") {
  TriMesh band;
  constexpr int kSteps = 12;
  for (int i = 0; i < kSteps; ++i)
    for (double side : {-0.2, 0.2}) {
      const double turn = 2.0 * 3.14159265358979 * i / kSteps;
      const double reach = 1.0 + side * std::cos(turn / 2);
      band.positions.emplace_back(reach * std::cos(turn), side * std::sin(turn / 2), reach * std::sin(turn));
    }
  for (Index i = 0; i < kSteps; ++i) {
    const Index a = 2 * i, b = 2 * i + 1;
    Index c = (2 * i + 2) % (2 * kSteps), d = (2 * i + 3) % (2 * kSteps);
    if (i + 1 == kSteps) std::swap(c, d);
    band.triangles.push_back({a, b, d});
    band.triangles.push_back({a, d, c});
  }
  const RepairedMesh got = repaired(band);
  CHECK(std::any_of(got.report.warnings.begin(), got.report.warnings.end(),
                    [](const auto& w) { return w.code == "not-orientable"; }));
}

TEST_CASE("every hostile mesh keeps the promises or is refused with a sentence") {
  for (const MeshCase& extreme : extreme_meshes()) {
    CAPTURE(extreme.name);
    const auto result = repair(Context{}, extreme.mesh);
    REQUIRE(result.ok() == extreme.usable);
    if (result.ok()) {
      check_promises(extreme.mesh, *result);
    } else {
      CHECK(result.error().code == ErrorCode::kUnusableGeometry);
      CHECK_FALSE(result.error().message.empty());
    }
  }
}

TEST_CASE("fins are dropped from a skin, walls inside it stay, and a garment keeps its flaps") {
  const TriMesh ball = icosphere(1.0, 3);
  TriMesh finned = ball;
  const auto tip = static_cast<Index>(ball.positions.size() / 2);
  for (std::size_t f = 0; f < ball.triangles.size(); f += 37) {
    const Triangle& at = ball.triangles[f];
    if (at[0] != tip && at[1] != tip) finned.triangles.push_back({at[0], at[1], tip});
  }
  const RepairedMesh clean = repaired(finned);
  check_promises(finned, clean);
  CHECK(clean.mesh.triangles == repaired(ball).mesh.triangles);
  CHECK(clean.report.warnings.size() == 1);
  CHECK(clean.report.warnings.front().code == "fins");

  auto kept = repair(Context{}, finned, {.drop_fins = false});
  REQUIRE(kept.ok());
  CHECK(kept->mesh.triangles.size() == finned.triangles.size());

  // The shape is a can with a wall across its middle and a window above the wall.
  TriMesh walled = cylinder(1.0, 2.0, 24, 4);
  std::vector<Index> ring;
  for (Index v = 0; v < walled.positions.size(); ++v)
    if (std::abs(walled.positions[v].y()) < 1e-9) ring.push_back(v);
  REQUIRE(ring.size() == 24);
  const auto angle = [&](Index v) { return std::atan2(walled.positions[v].z(), walled.positions[v].x()); };
  std::sort(ring.begin(), ring.end(), [&](Index i, Index j) { return angle(i) < angle(j); });
  const auto window = std::find_if(walled.triangles.begin(), walled.triangles.end(), [&](const Triangle& t) {
    return walled.positions[t[0]].y() + walled.positions[t[1]].y() + walled.positions[t[2]].y() > 0.9;
  });
  REQUIRE(window != walled.triangles.end());
  walled.triangles.erase(window);
  for (std::size_t k = 2; k < ring.size(); ++k) walled.triangles.push_back({ring[0], ring[k - 1], ring[k]});
  const RepairedMesh two_rooms = repaired(walled);
  CHECK(two_rooms.mesh.triangles.size() == walled.triangles.size());
  CHECK(two_rooms.report.non_manifold_edges == ring.size());
}

TEST_CASE("repair does not depend on where the input's vertices are numbered") {
  const TriMesh mesh = soup(icosphere(1.0, 3));
  const RepairedMesh a = repaired(mesh);
  const RepairedMesh b = repaired(shuffled(mesh, 4));
  CHECK(a.mesh.positions.size() == b.mesh.positions.size());
  CHECK(signed_volume(a.mesh) == doctest::Approx(signed_volume(b.mesh)).epsilon(1e-12));
}

TEST_CASE("options out of range are refused") {
  for (double weld : {-1.0, 1.0, std::nan("")})
    CHECK(repair(Context{}, icosphere(1.0, 1), {.weld_relative = weld}).error().code ==
          ErrorCode::kInvalidArgument);
}

TEST_CASE("components are ordered by area") {
  const TriMesh mesh = joined(icosphere(0.5, 2), joined(icosphere(2.0, 1), sheet(0.1, 0.1, 1, 1)));
  const Components components = connected_components(mesh);
  REQUIRE(components.area.size() == 3);
  CHECK(std::is_sorted(components.area.rbegin(), components.area.rend()));
  CHECK(components.of_vertex.front() == 1);
  CHECK(components.of_vertex.back() == 2);
}

TEST_CASE("the largest components keep their triangles and the vertices that these use, and no others") {
  const TriMesh large = icosphere(2.0, 1), middle = icosphere(0.5, 2), small = sheet(0.1, 0.1, 1, 1);
  TriMesh mesh = joined(middle, joined(large, small));
  mesh.positions.push_back(Vec3(7.0, 7.0, 7.0));  // no triangle uses it
  const Components components = connected_components(mesh);
  for (const auto& [count, expected] : {std::pair{1, large}, {2, joined(middle, large)}}) {
    const TriMesh kept = largest_components(mesh, components, static_cast<std::size_t>(count));
    CHECK(kept.positions.size() == expected.positions.size());
    REQUIRE(kept.triangles.size() == expected.triangles.size());
    for (std::size_t t = 0; t < kept.triangles.size(); ++t)
      for (int k = 0; k < 3; ++k)
        CHECK(kept.positions[kept.triangles[t][k]] == expected.positions[expected.triangles[t][k]]);
  }
}

TEST_CASE(
    "the awkward files are repaired to the counts of vertices, components and handles that they were made "
    "with") {
  struct Row {
    const char* file;
    std::size_t vertices;
    std::size_t components;
    int euler;
  };
  // Each row is a file, its vertices and triangles, and 2 for each closed component of genus 0.
  const Row rows[] = {{"awkward/f_avg_far_origin.obj", 3000, 1, 2},
                      {"awkward/f_avg_inverted.obj", 3000, 1, 2},
                      {"awkward/f_avg_mixed_winding.obj", 3000, 1, 2},
                      {"awkward/f_avg_soup.stl", 3000, 1, 2},
                      {"awkward/f_avg_zup_cm.obj", 3000, 1, 2},
                      {"bodies/f_avg_rest.obj", 13380, 1, 2},
                      {"awkward/f_avg_nonmanifold_degenerate.obj", 3000, 1, 2}};
  for (const Row& row : rows) {
    const auto file = data_file(row.file);
    if (!file) continue;
    CAPTURE(row.file);
    const TriMesh input = read_mesh(*file);
    const RepairedMesh got = repaired(input);
    check_promises(input, got);
    CHECK(got.mesh.positions.size() == row.vertices);
    CHECK(got.report.components == row.components);
    CHECK(got.report.euler_characteristic == row.euler);
    CHECK(got.report.boundary_edges == 0);
    CHECK(signed_volume(got.mesh) > 0.0);
  }
  for (const char* name : {"awkward/f_avg_holes.obj", "awkward/m_avg_as_exported_dm.obj",
                           "awkward/makehuman_base_raw_dm_helpers.obj"}) {
    const auto file = data_file(name);
    if (!file) continue;
    CAPTURE(name);
    const TriMesh input = read_mesh(*file);
    const RepairedMesh got = repaired(input);
    check_promises(input, got);
    CHECK_FALSE(got.report.warnings.empty());
    MESSAGE(std::string(name) << ": " << got.mesh.positions.size() << " vertices, " << got.report.components
                              << " components, " << got.report.boundary_edges << " open, "
                              << got.report.non_manifold_edges << " non-manifold, "
                              << got.report.flipped_triangles << " flipped, " << got.report.dropped_triangles
                              << " dropped");
  }
}
