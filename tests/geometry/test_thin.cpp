// Surfaces with fewer vertices: what they keep, and how far off they are.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include <bodice/engine/random.hpp>
#include <bodice/geometry/mesh_distance.hpp>
#include <bodice/geometry/mesh_edges.hpp>
#include <bodice/geometry/thin.hpp>
#include <bodice_test/executors.hpp>
#include <bodice_test/shapes.hpp>

using namespace bodice;
using namespace bodice::geometry;

namespace {

constexpr double kRadius_m = 0.3;
constexpr ThinOptions kThree{.edge_m = 0.008, .tolerance_m = 3e-4};  // a sphere of level 6 has edges of 5 mm

double farthest_off(const TriMesh& fine, const TriMesh& thinned) {
  const MeshDistance distance({}, thinned);
  double farthest = 0.0;
  for (const Vec3& p : fine.positions) farthest = std::max(farthest, std::abs(distance.signed_distance(p)));
  return farthest;
}

/// The least height of a triangle over its longest side.
double flattest(const TriMesh& mesh) {
  double least = 1.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    double longest2 = 0.0;
    for (int k = 0; k < 3; ++k)
      longest2 = std::max(longest2, (mesh.corner(t, k) - mesh.corner(t, (k + 1) % 3)).squaredNorm());
    least = std::min(least, area_vector(mesh, t).norm() / longest2);
  }
  return least;
}

/// Vertices and triangles of the input are those that the maps say.
void check_maps(const TriMesh& fine, const ThinnedSurface& thinned) {
  REQUIRE(thinned.kept.size() == thinned.mesh.positions.size());
  REQUIRE(thinned.vertex_of_input.size() == fine.positions.size());
  REQUIRE(thinned.triangle_of_input.size() == fine.triangles.size());
  CHECK(std::is_sorted(thinned.kept.begin(), thinned.kept.end()));
  bool same = true;
  for (Index v = 0; v < thinned.kept.size(); ++v)
    same = same && thinned.mesh.positions[v] == fine.positions[thinned.kept[v]] &&
           thinned.vertex_of_input[thinned.kept[v]] == v;
  CHECK(same);
  std::set<Index> triangles;
  for (std::size_t t = 0; t < fine.triangles.size(); ++t) {
    const Index to = thinned.triangle_of_input[t];
    if (to == kNoIndex) continue;
    triangles.insert(to);
    for (std::size_t k = 0; k < 3; ++k)
      same = same && thinned.mesh.triangles[to][k] == thinned.vertex_of_input[fine.triangles[t][k]];
  }
  CHECK(same);
  CHECK(triangles.size() == thinned.mesh.triangles.size());
}

}  // namespace

TEST_CASE("a thinned sphere has a fraction of the vertices, its topology and its shape") {
  const TriMesh fine = bodice_test::icosphere(kRadius_m, 6);
  const ThinnedSurface thinned = thin({}, fine, kThree);
  const TriMesh& mesh = thinned.mesh;
  CHECK(mesh.positions.size() < fine.positions.size() * 2 / 5);
  const MeshEdges edges = mesh_edges(mesh);
  CHECK(edges.boundary == 0);
  CHECK(edges.non_manifold == 0);
  CHECK(euler_characteristic(mesh, edges) == 2);
  CHECK(signed_volume(mesh) == doctest::Approx(signed_volume(fine)).epsilon(2e-3));
  CHECK(flattest(mesh) > 0.18);
  CHECK(farthest_off(fine, mesh) < 2.0 * kThree.tolerance_m);
  check_maps(fine, thinned);
}

TEST_CASE("edges from the given length on stay, and so does what is curved") {
  const TriMesh fine = bodice_test::icosphere(kRadius_m, 6);
  CHECK(thin({}, fine, {.edge_m = 0.004, .tolerance_m = 1.0}).mesh.triangles == fine.triangles);
  CHECK(thin({}, fine, {.edge_m = 1.0, .tolerance_m = 0.0}).mesh.triangles == fine.triangles);
  CHECK(thin({}, {}, kThree).mesh.empty());
  const TriMesh torus = bodice_test::torus(0.3, 0.1, 300, 100);
  const MeshEdges edges = mesh_edges(thin({}, torus, kThree).mesh);
  CHECK(edges.boundary == 0);
  CHECK(edges.non_manifold == 0);
}

TEST_CASE("rims and edges of three triangles stay") {
  TriMesh sheet = bodice_test::sheet(4.0, 0.5, 400, 50);
  const auto first = static_cast<Index>(sheet.positions.size());
  const Index a = static_cast<Index>(sheet.positions.size() / 2);
  sheet.positions.push_back(sheet.positions[a] + Vec3(0.0, 0.01, 0.0));
  sheet.triangles.push_back({a, a + 1, first});
  const MeshEdges before = mesh_edges(sheet);
  REQUIRE(before.non_manifold == 1);
  const ThinnedSurface thinned = thin({}, sheet, {.edge_m = 0.03, .tolerance_m = 1e-4});
  CHECK(thinned.mesh.positions.size() < sheet.positions.size() / 2);
  const MeshEdges after = mesh_edges(thinned.mesh);
  CHECK(after.boundary == before.boundary);
  CHECK(after.non_manifold == before.non_manifold);
  CHECK(surface_area(thinned.mesh) == doctest::Approx(surface_area(sheet)));
  check_maps(sheet, thinned);
}

TEST_CASE("a noisy surface is thinned by its shape, and what stays has no noise") {
  constexpr double kNoise_m = 0.0015;
  TriMesh noisy = bodice_test::icosphere(kRadius_m, 7);
  engine::Random random(3, 1);
  for (Vec3& p : noisy.positions) p += kNoise_m * random.normal() * p.normalized();
  const ThinnedSurface thinned = thin_noisy({}, noisy, kNoise_m, {.edge_m = 0.004, .tolerance_m = 1e-4});
  CHECK(thinned.mesh.positions.size() < noisy.positions.size() / 3);
  CHECK(euler_characteristic(thinned.mesh, mesh_edges(thinned.mesh)) == 2);
  double off = 0.0;
  for (const Vec3& p : thinned.mesh.positions) off += std::abs(p.norm() - kRadius_m);
  CHECK(off / static_cast<double>(thinned.mesh.positions.size()) < 0.25 * 0.8 * kNoise_m);
}

TEST_CASE("what is as thin as a finger keeps its width where its noise is taken out") {
  constexpr double kNoise_m = 0.001, kRing_m = 0.2, kFinger_m = 0.008;
  TriMesh noisy = bodice_test::torus(kRing_m, kFinger_m, 1000, 40);
  const auto middle = [=](const Vec3& p) { return Vec3(kRing_m * Vec3(p.x(), 0.0, p.z()).normalized()); };
  engine::Random random(5, 2);
  for (Vec3& p : noisy.positions) p += kNoise_m * random.normal() * (p - middle(p)).normalized();
  const ThinnedSurface thinned = thin_noisy({}, noisy, kNoise_m, {.edge_m = 0.002, .tolerance_m = 1e-4});
  CHECK(thinned.mesh.positions.size() < noisy.positions.size() / 2);
  double off = 0.0, wider = 0.0;
  for (const Vec3& p : thinned.mesh.positions) {
    const double width = (p - middle(p)).norm() - kFinger_m;
    off += std::abs(width);
    wider += width;
  }
  const auto count = static_cast<double>(thinned.mesh.positions.size());
  CHECK(off / count < 0.3 * kNoise_m);
  CHECK(std::abs(wider) / count < 0.05 * kNoise_m);
}

TEST_CASE("a thinned surface has the same bits for any number of workers") {
  const TriMesh fine = bodice_test::icosphere(kRadius_m, 6);
  const ThinnedSurface one = thin({}, fine, kThree);
  for (const auto& [name, executor] : bodice_test::all_executors()) {
    CAPTURE(name);
    const ThinnedSurface many = thin({.executor = executor.get()}, fine, kThree);
    CHECK(many.kept == one.kept);
    CHECK(many.mesh.triangles == one.mesh.triangles);
  }
}
