#include <doctest/doctest.h>

#include <bodice/geodesic/isoline.hpp>

#include "shapes.hpp"

using namespace bodice;

namespace {

std::vector<float> heights(const geometry::TriMesh& mesh) {
  std::vector<float> z;
  for (const auto& p : mesh.positions) z.push_back(static_cast<float>(p.z()));
  return z;
}

}  // namespace

TEST_CASE("levels of height on a sphere are circles of known girth and center") {
  const auto mesh = shapes::sphere(5);
  const auto edges = geometry::mesh_edges(mesh);
  const auto z = heights(mesh);
  const std::array<float, 4> levels{0.5F, -0.9F, 0.1F, 0.0F};  // unsorted, and 0 meets vertices exactly
  const auto lines = geodesic::isolines(mesh, edges, z, levels);
  for (std::size_t i = 0; i < levels.size(); ++i) {
    REQUIRE(lines[i].size() == 1);
    const auto& loop = lines[i][0];
    CHECK(loop.closed);
    const double level = static_cast<double>(levels[i]);
    CHECK(loop.girth_m == doctest::Approx(2.0 * M_PI * std::sqrt(1.0 - level * level)).epsilon(0.01));
    CHECK((loop.centroid - geometry::Vec3(0, 0, level)).norm() < 0.01);
    for (const auto& p : loop.points) REQUIRE(std::abs(p.z() - level) < 1e-6);
  }
}

TEST_CASE("consecutive points of a loop share a triangle") {
  const auto mesh = shapes::sphere(3);
  const auto edges = geometry::mesh_edges(mesh);
  const float level = 0.3F;
  const auto loop = geodesic::isolines(mesh, edges, heights(mesh), {&level, 1})[0][0];
  for (std::size_t i = 0; i < loop.edges.size(); ++i) {
    const auto a = edges.triangles[loop.edges[i]],
               b = edges.triangles[loop.edges[(i + 1) % loop.edges.size()]];
    REQUIRE((a[0] == b[0] || a[0] == b[1] || a[1] == b[0] || a[1] == b[1]));
  }
}

TEST_CASE("a curve that meets a hole is open, and runs from border to border") {
  const auto mesh = shapes::grid(8);
  std::vector<float> x;
  for (const auto& p : mesh.positions) x.push_back(static_cast<float>(p.x()));
  const float level = 0.4F;
  const auto lines = geodesic::isolines(mesh, geometry::mesh_edges(mesh), x, {&level, 1})[0];
  REQUIRE(lines.size() == 1);
  CHECK(!lines[0].closed);
  CHECK(lines[0].girth_m == doctest::Approx(1.0));
  CHECK(std::abs(lines[0].points.front().y() - lines[0].points.back().y()) == doctest::Approx(1.0));
}

TEST_CASE("two separate loops of one level are two curves") {
  auto mesh = shapes::sphere(3);
  std::vector<float> field;
  for (const auto& p : mesh.positions) field.push_back(static_cast<float>(std::abs(p.z())));
  const float level = 0.5F;
  CHECK(geodesic::isolines(mesh, geometry::mesh_edges(mesh), field, {&level, 1})[0].size() == 2);
}

TEST_CASE("levels outside the field, no levels and unreachable corners give no curve") {
  const auto mesh = shapes::sphere(2);
  const auto edges = geometry::mesh_edges(mesh);
  const std::array<float, 2> outside{-3.0F, 7.0F};
  for (const auto& lines : geodesic::isolines(mesh, edges, heights(mesh), outside)) CHECK(lines.empty());
  CHECK(geodesic::isolines(mesh, edges, heights(mesh), {}).empty());
  const std::vector<float> nowhere(mesh.positions.size(), std::numeric_limits<float>::infinity());
  const float level = 1.0F;
  CHECK(geodesic::isolines(mesh, edges, nowhere, {&level, 1})[0].empty());
}
