#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>

#include <bodice/engine/random.hpp>
#include <bodice/geometry/contour.hpp>
#include <bodice/geometry/mesh_edges.hpp>
#include <bodice/geometry/mesh_repair.hpp>
#include <bodice/geometry/rebuild.hpp>
#include <bodice_test/executors.hpp>
#include <bodice_test/shapes.hpp>

using namespace bodice;
using geometry::Box;
using geometry::TriMesh;
using geometry::Vec3;

namespace {

Box unit_box() {
  return {Vec3::Constant(-1.0), Vec3::Constant(1.0)};
}

void check_closed(const TriMesh& mesh, int components) {
  const geometry::MeshEdges edges = geometry::mesh_edges(mesh);
  CHECK(edges.boundary == 0);
  CHECK(edges.non_manifold == 0);
  CHECK(geometry::euler_characteristic(mesh, edges) == 2 * components);
}

/// The triangles of a mesh with a middle that a predicate accepts.
template <class Keep>
TriMesh kept(TriMesh mesh, Keep&& keep) {
  std::erase_if(mesh.triangles, [&](const geometry::Triangle& t) {
    return !keep(Vec3((mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]) / 3.0));
  });
  return mesh;
}

double worst_radius_error(const TriMesh& mesh, double radius) {
  double worst = 0.0;
  for (const Vec3& p : mesh.positions) worst = std::max(worst, std::abs(p.norm() - radius));
  return worst;
}

/// The grid with the field's own value at each node.
template <class Field>
geometry::FieldGrid valued(geometry::FieldGrid grid, const Field& field) {
  for (std::size_t z = 0; z < grid.nodes[2]; ++z)
    for (std::size_t y = 0; y < grid.nodes[1]; ++y)
      for (std::size_t x = 0; x < grid.nodes[0]; ++x) {
        const Vec3 node(static_cast<double>(x), static_cast<double>(y), static_cast<double>(z));
        grid.value[grid.index(x, y, z)] = static_cast<float>(field(Vec3(grid.low + grid.cell_m * node)));
      }
  return grid;
}

void check_same(const TriMesh& a, const TriMesh& b) {
  REQUIRE(!a.triangles.empty());
  CHECK(a.positions == b.positions);
  CHECK(a.triangles == b.triangles);
}

}  // namespace

TEST_CASE("blocks that one value decides leave the contour as it is, to the bit, with fewer calls") {
  std::size_t calls = 0;
  const auto balls = [&](const Vec3& p) {
    ++calls;
    return std::min((p - Vec3(0.3, 0.1, 0.0)).norm() - 0.5, (p + Vec3(0.4, 0.3, 0.2)).norm() - 0.4);
  };
  const auto grid = geometry::sample_field({}, balls, unit_box(), 0.02);
  CHECK(calls < grid.value.size() / 6);
  check_same(geometry::contour({}, grid), geometry::contour({}, valued(grid, balls)));

  const TriMesh open = kept(bodice_test::icosphere(0.8, 4), [](const Vec3& p) { return p.y() < 0.6; });
  const geometry::MeshDistance distance({}, open);
  const auto inside = geometry::sample_inside({}, distance, unit_box(), 0.03);
  const auto exact = valued(inside, [&](const Vec3& p) { return distance.signed_distance(p); });
  check_same(geometry::contour({}, inside), geometry::contour({}, exact));
}

TEST_CASE("fields of one distance, sampled in turn, have the bits of each sampled alone") {
  const auto ball = [](const Vec3& p) { return (p - Vec3(0.1, 0.0, -0.2)).norm() - 0.6; };
  const auto executor = bodice_test::make_threads(3);
  const engine::Context threads{.executor = executor.get()};
  std::atomic<int> calls = 0;
  const auto counted = [&](const Vec3& p) { return ++calls, ball(p); };
  geometry::NodeDistances distances(counted, unit_box(), 0.03);
  int before = 0;
  for (const double depth : {0.0, 0.1, -0.05, 0.1}) {
    CAPTURE(depth);
    const auto below_or_cut = [&](double distance_m, const Vec3& p) {
      return std::max(distance_m + depth, depth - p.y());
    };
    const auto alone = [&](const Vec3& p) { return below_or_cut(ball(p), p); };
    const geometry::FieldGrid expected = geometry::sample_field({}, alone, unit_box(), 0.03);
    const geometry::FieldGrid found = distances.sample(threads, below_or_cut);
    CHECK(found.value == expected.value);
    CHECK(found.nodes == expected.nodes);
    before = calls.exchange(0);
  }
  CHECK(before == 0);  // what the second field needed is known when it is sampled again
}

TEST_CASE("the contour of a ball is closed, wound outward and as large as the ball") {
  const auto ball = [](const Vec3& p) { return p.norm() - 0.8; };
  const auto grid = geometry::sample_field({}, ball, unit_box(), 0.05);
  const TriMesh mesh = geometry::contour({}, grid);
  check_closed(mesh, 1);
  CHECK(worst_radius_error(mesh, 0.8) < 0.002);
  CHECK(signed_volume(mesh) == doctest::Approx(4.0 / 3.0 * std::numbers::pi * 0.512).epsilon(0.01));
}

TEST_CASE("regions that touch along the diagonal of a cell stay apart, and the surface stays manifold") {
  geometry::FieldGrid grid{Vec3::Zero(), 1.0, {5, 5, 5}, std::vector<float>(125, 1.0f)};
  SUBCASE("two nodes across a face") {
    grid.value[grid.index(1, 1, 2)] = grid.value[grid.index(2, 2, 2)] = -1.0f;
  }
  SUBCASE("two nodes across a cell") {
    grid.value[grid.index(1, 1, 1)] = grid.value[grid.index(2, 2, 2)] = -1.0f;
  }
  const TriMesh mesh = geometry::contour({}, grid);
  check_closed(mesh, 2);
  CHECK(geometry::connected_components(mesh).area.size() == 2);
}

TEST_CASE("a contour encloses the nodes that are inside, for random grids") {
  engine::Random random(3);
  for (int round = 0; round < 20; ++round) {
    geometry::FieldGrid grid{Vec3::Zero(), 1.0, {7, 7, 7}, std::vector<float>(343, 1.0f)};
    int inside = 0;
    for (std::size_t z = 1; z < 6; ++z)
      for (std::size_t y = 1; y < 6; ++y)
        for (std::size_t x = 1; x < 6; ++x)
          if (random.below(3) == 0) grid.value[grid.index(x, y, z)] = -1.0f, ++inside;
    const TriMesh mesh = geometry::contour({}, grid);
    const geometry::MeshDistance distance({}, mesh);
    CHECK(geometry::mesh_edges(mesh).boundary == 0);
    int found = 0;
    for (std::size_t z = 0; z < 7; ++z)
      for (std::size_t y = 0; y < 7; ++y)
        for (std::size_t x = 0; x < 7; ++x) {
          const Vec3 node(static_cast<double>(x), static_cast<double>(y), static_cast<double>(z));
          const bool is_inside = distance.winding_number(node) > 0.5;
          CHECK(is_inside == (grid.value[grid.index(x, y, z)] < 0.0f));
          found += is_inside;
        }
    CHECK(found == inside);
  }
}

TEST_CASE(
    "a ball of loose patches with gaps and a hole is rebuilt closed, on the ball where it was measured") {
  const TriMesh ball = bodice_test::icosphere(1.0, 5);
  TriMesh patches = kept(ball, [](const Vec3& p) { return p.x() > 0.03 && p.y() < 0.9; });
  patches =
      bodice_test::joined(patches, kept(ball, [](const Vec3& p) { return p.x() < -0.03 && p.y() < 0.9; }));
  const auto rebuilt = geometry::rebuild({}, patches, 0.04);
  check_closed(rebuilt.mesh, 1);
  double worst = 0.0;
  for (std::size_t v = 0; v < rebuilt.measured.size(); ++v)
    if (rebuilt.measured[v])
      worst = std::max(worst, std::abs(rebuilt.mesh.positions[v].norm() - 1.0));
    else
      CHECK((rebuilt.mesh.positions[v].y() > 0.85 || std::abs(rebuilt.mesh.positions[v].x()) < 0.1));
  CHECK(worst < 0.002);
  CHECK(rebuilt.measured_share > 0.9);
  CHECK(rebuilt.measured_share < 1.0);
  CHECK(signed_volume(rebuilt.mesh) == doctest::Approx(4.0 / 3.0 * std::numbers::pi).epsilon(0.03));
}

TEST_CASE("a rebuilt surface has the same bits for any number of workers") {
  const TriMesh half = kept(bodice_test::icosphere(1.0, 4), [](const Vec3& p) { return p.y() < 0.6; });
  const auto one = geometry::rebuild({}, half, 0.06);
  const auto workers = engine::make_tbb_executor(3);
  const auto three = geometry::rebuild({.executor = workers.get()}, half, 0.06);
  REQUIRE(one.mesh.triangles == three.mesh.triangles);
  for (std::size_t v = 0; v < one.mesh.positions.size(); ++v)
    CHECK(one.mesh.positions[v] == three.mesh.positions[v]);
}
