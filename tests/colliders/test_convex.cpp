// Hulls are judged by what a convex hull is, pieces by the skin they stand for.
#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <set>

#include <bodice/colliders/convex_pieces.hpp>
#include <bodice/fitting/fit.hpp>
#include <bodice/synth/body.hpp>
#include <bodice_test/executors.hpp>

using namespace bodice;
using geometry::Vec3;

namespace {

/// Closed and edge-manifold, by directed edges.
void check_closed(const geometry::TriMesh& mesh) {
  std::set<std::pair<geometry::Index, geometry::Index>> edges;
  for (const geometry::Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) CHECK(edges.emplace(t[k], t[(k + 1) % 3]).second);
  for (const auto& [a, b] : edges) CHECK(edges.contains({b, a}));
  CHECK(mesh.positions.size() + mesh.triangles.size() == edges.size() / 2 + 2);  // Euler, of a sphere
}

/// The height of a point over the highest plane of a hull.
double above(const geometry::TriMesh& hull, const Vec3& point) {
  double most = -1e9;
  for (std::size_t t = 0; t < hull.triangles.size(); ++t)
    most = std::max(
        most, geometry::area_vector(hull, t).normalized().dot(point - hull.positions[hull.triangles[t][0]]));
  return most;
}

}  // namespace

TEST_CASE("a convex hull holds all points, has only points as vertices, and every edge has two triangles") {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (const double flatness : {1.0, 0.1, 1e-4})
    for (const double size : {1e-3, 1.0, 1e3})
      for (int n : {4, 5, 20, 300}) {
        std::vector<Vec3> points;
        for (int i = 0; i < n; ++i)
          points.push_back(size * Vec3(normal(random), flatness * normal(random), normal(random)) +
                           Vec3(3, 2, 1));
        points.push_back(points.front());  // a duplicate
        const geometry::TriMesh hull = colliders::convex_hull(points);
        REQUIRE_FALSE(hull.empty());
        check_closed(hull);
        CHECK(geometry::signed_volume(hull) > 0.0);
        for (const Vec3& p : points) CHECK(above(hull, p) < 1e-7 * size);
        for (const Vec3& v : hull.positions) CHECK(std::ranges::find(points, v) != points.end());
      }
}

TEST_CASE("a convex hull of a grid's points is the box, and of a plane's points is none") {
  std::vector<Vec3> grid, plane;
  for (int i = 0; i < 125; ++i) grid.emplace_back(i % 5, i / 5 % 5, i / 25);
  for (int i = 0; i < 25; ++i) plane.emplace_back(i % 5, i / 5, 2.0);
  const geometry::TriMesh box = colliders::convex_hull(grid);
  check_closed(box);
  CHECK(geometry::signed_volume(box) == doctest::Approx(64.0).epsilon(1e-12));
  CHECK(colliders::convex_hull(plane).empty());
  CHECK(colliders::convex_hull({}).empty());
  CHECK(colliders::convex_hull(std::vector<Vec3>(10, Vec3(1, 1, 1))).empty());
}

TEST_CASE(
    "convex pieces stand for the skin within millimeters, the closer the more they are, for any workers") {
  synth::BodyOptions options;
  options.vertices = 3000;
  const auto body = synth::make_body({}, options);
  REQUIRE(body.ok());
  const geometry::MeshDistance distance({}, body->mesh);
  const fitting::LabeledSkin skin{body->mesh, body->part, body->stature_m, {}, &distance};
  fitting::FitOptions fit_options;
  fit_options.tier = proxy::Tier::kSolid;
  const auto fit = fitting::fit({}, skin, fit_options);
  REQUIRE(fit.ok());
  const colliders::SkinPoints points = colliders::skin_points({}, fit->proxy, body->mesh);
  double last_m = 1.0;
  for (const int count : {16, 32, 64}) {
    const auto pieces = colliders::convex_pieces({}, fit->proxy, points, count);
    REQUIRE(pieces.ok());
    CHECK(pieces->size() <= static_cast<std::size_t>(count));
    for (const colliders::ConvexPiece& piece : *pieces) {
      check_closed(piece.mesh);
      CHECK(piece.mesh.positions.size() <= colliders::kMostCorners);
    }
    const colliders::ReductionCost cost = colliders::cost_of_pieces({}, fit->proxy, points, *pieces);
    MESSAGE(count << " pieces: mean " << 1e3 * cost.whole.mean_m << " mm, worst "
                  << 1e3 * cost.whole.worst_m);
    CHECK(cost.whole.mean_m < last_m);
    last_m = cost.whole.mean_m;
    for (const auto& [name, executor] : bodice_test::all_executors()) {
      const auto again = colliders::convex_pieces({.executor = executor.get()}, fit->proxy, points, count);
      REQUIRE(again.ok());
      REQUIRE(again->size() == pieces->size());
      for (std::size_t i = 0; i < pieces->size(); ++i)
        CHECK((*again)[i].mesh.positions == (*pieces)[i].mesh.positions);
    }
  }
  CHECK(last_m < 0.005);
  CHECK_FALSE(colliders::convex_pieces({}, fit->proxy, points, 0).ok());
}
