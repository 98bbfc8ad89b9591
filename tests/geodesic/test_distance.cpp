#include <doctest/doctest.h>

#include <bodice/engine/random.hpp>
#include <bodice/geodesic/distance_by_heap.hpp>
#include <bodice_test/executors.hpp>

#include "shapes.hpp"

using namespace bodice;
using geodesic::Metric;

namespace {

geodesic::EdgeGraph graph_of(const geometry::TriMesh& mesh, Metric metric) {
  return geodesic::edge_graph({}, mesh, geometry::mesh_edges(mesh), metric);
}

/// The worst and the mean relative error against great circles, beyond a tenth of the half circle.
std::pair<double, double> sphere_error(const geometry::TriMesh& mesh, const geodesic::Field& field) {
  double worst = 0.0, sum = 0.0;
  int count = 0;
  for (std::size_t v = 0; v < field.size(); ++v) {
    const double truth = std::acos(std::clamp(mesh.positions[v].z(), -1.0, 1.0));
    if (truth < 0.3) continue;
    const double error = static_cast<double>(field[v]) / truth - 1.0;
    worst = std::max(worst, error);
    sum += error;
    ++count;
  }
  return {worst, sum / count};
}

}  // namespace

TEST_CASE("the bucket queue gives the textbook method's bits") {
  // The sphere is stretched and noisy, so that many buckets are empty and others crowded.
  auto mesh = shapes::sphere(4);
  engine::Random random(3);
  for (auto& p : mesh.positions)
    p = geometry::Vec3(40.0 * p.x(), p.y(), 0.01 * p.z()) * (1.0 + 0.2 * random.uniform());
  for (const Metric metric : {Metric::kEdges, Metric::kUnfolded}) {
    const auto graph = graph_of(mesh, metric);
    for (geometry::Index source = 0; source < 900; source += 97) {
      const geodesic::Seed seed{source, 0.0F};
      CHECK(geodesic::distances_from(graph, source) == geodesic::distances_by_heap(graph, {&seed, 1}));
    }
    const std::array<geodesic::Seed, 3> seeds{{{5, 0.7F}, {600, 0.0F}, {601, 33.0F}}};
    CHECK(geodesic::distances(graph, seeds) == geodesic::distances_by_heap(graph, seeds));
  }
}

TEST_CASE("links across unfolded triangles halve the error on a sphere, and none is too short") {
  const auto mesh = shapes::sphere(5);
  const auto plain = sphere_error(mesh, geodesic::distances_from(graph_of(mesh, Metric::kEdges), 0));
  const auto better = sphere_error(mesh, geodesic::distances_from(graph_of(mesh, Metric::kUnfolded), 0));
  CHECK(better.second < 0.5 * plain.second);
  CHECK(better.first < 0.083);    // a vertex has eight directions at worst: 1 / cos(22.5 degrees) - 1
  CHECK(better.second > -0.001);  // chords are shorter than arcs, by no more than this at this resolution
}

TEST_CASE("along its edges a flat grid is exact, and no distance is below the straight line") {
  const auto mesh = shapes::grid(16);
  const auto field = geodesic::distances_from(graph_of(mesh, Metric::kUnfolded), 0);
  CHECK(field[16] == doctest::Approx(1.0));
  CHECK(field[16 * 17 + 16] == doctest::Approx(std::sqrt(2.0)));
  for (std::size_t v = 0; v < field.size(); ++v)
    REQUIRE(static_cast<double>(field[v]) >= mesh.positions[v].norm() * (1.0 - 1e-5));
}

TEST_CASE("distances scale with the mesh and do not depend on its position") {
  const auto reference = geodesic::distances_from(graph_of(shapes::sphere(3), Metric::kUnfolded), 7);
  for (const double scale : {1e-6, 1.0, 1e6})
    for (const double away : {0.0, 1e4}) {
      if (scale < 1.0 && away > 0.0) continue;  // edges of 1e-6 m at 10 km are below what a double resolves
      const auto field = geodesic::distances_from(
          graph_of(shapes::sphere(3, scale, away * geometry::Vec3(1, -1, 1)), Metric::kUnfolded), 7);
      for (std::size_t v = 0; v < field.size(); ++v)
        REQUIRE(static_cast<double>(field[v]) / scale ==
                doctest::Approx(static_cast<double>(reference[v])).epsilon(1e-5));
    }
}

TEST_CASE("what no source reaches is unreachable, and sources outside the mesh are ignored") {
  auto mesh = shapes::sphere(1);
  const auto far = shapes::sphere(1, 1.0, {5, 0, 0});
  const auto offset = static_cast<geometry::Index>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), far.positions.begin(), far.positions.end());
  for (auto t : far.triangles) mesh.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
  const auto graph = graph_of(mesh, Metric::kEdges);
  const auto field = geodesic::distances_from(graph, 0);
  CHECK(field[offset] == geodesic::kUnreachable);
  CHECK(std::isfinite(field[offset - 1]));
  CHECK(geodesic::descend(graph, field, offset).empty());
  CHECK(geodesic::distances_from(graph, 100000)[0] == geodesic::kUnreachable);
  const std::array<geometry::Index, 3> sources{0, offset, 100000};
  const auto nearest = geodesic::nearest_sources(graph, sources);
  for (geometry::Index v = 0; v < 2 * offset; ++v) CHECK(nearest.source[v] == (v < offset ? 0u : 1u));
}

TEST_CASE("within a distance every bit is as without the limit, and beyond it nothing is reached") {
  const auto mesh = shapes::sphere(4);
  const auto graph = graph_of(mesh, Metric::kUnfolded);
  // The second seed starts beyond all that the first one reaches within the lesser limits.
  const std::array<geodesic::Seed, 3> seeds{{{5, 0.0F}, {600, 0.9F}, {601, 33.0F}}};
  const auto all = geodesic::distances(graph, seeds);
  for (const float most : {0.0F, 0.05F, 0.5F, 0.95F, 1.6F, 40.0F}) {
    const auto field = geodesic::distances_within(graph, seeds, most);
    for (std::size_t v = 0; v < all.size(); ++v)
      REQUIRE(field[v] == (all[v] <= most ? all[v] : geodesic::kUnreachable));
  }
}

TEST_CASE("the multi-source run is the least of single runs, ties to the first") {
  const auto mesh = shapes::grid(10);
  const auto graph = graph_of(mesh, Metric::kUnfolded);
  const std::array<geometry::Index, 4> sources{0, 10, 110, 120};  // the corners: many ties
  const auto nearest = geodesic::nearest_sources(graph, sources);
  const auto each = geodesic::distances_each({}, graph, sources);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    geometry::Index least = 0;
    for (geometry::Index s = 1; s < 4; ++s)
      if (each[s][v] < each[least][v]) least = s;
    REQUIRE(nearest.distance[v] == each[least][v]);
    REQUIRE(each[nearest.source[v]][v] == each[least][v]);
  }
}

TEST_CASE("any number of workers gives the same bits") {
  const auto mesh = shapes::sphere(4);
  const auto graph = graph_of(mesh, Metric::kUnfolded);
  const std::array<geometry::Index, 5> sources{0, 17, 300, 512, 1000};
  const auto serial = geodesic::distances_each({}, graph, sources);
  for (const int workers : {2, 4}) {
    const auto executor = bodice_test::make_threads(workers);
    engine::Context context;
    context.executor = executor.get();
    CHECK(geodesic::distances_each(context, graph, sources) == serial);
    CHECK(graph_of(mesh, Metric::kUnfolded).links.size() ==
          geodesic::edge_graph(context, mesh, geometry::mesh_edges(mesh), Metric::kUnfolded).links.size());
  }
}

TEST_CASE("a path descends to its source and is as long as its distance") {
  const auto mesh = shapes::sphere(4);
  const auto graph = graph_of(mesh, Metric::kEdges);
  const auto field = geodesic::distances_from(graph, 0);
  const auto path = geodesic::descend(graph, field, 5);
  REQUIRE(path.size() > 2);
  CHECK(path.front() == 5);
  CHECK(path.back() == 0);
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i)
    length += (mesh.positions[path[i]] - mesh.positions[path[i - 1]]).norm();
  CHECK(length == doctest::Approx(static_cast<double>(field[5])).epsilon(1e-5));
}

TEST_CASE("degenerate meshes end, with finite distances where there is a path") {
  geometry::TriMesh mesh;
  CHECK(geodesic::distances_from(graph_of(mesh, Metric::kUnfolded), 0).empty());
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 0, 0}};
  mesh.triangles = {{0, 1, 2}, {1, 2, 3}, {2, 3, 3}};  // collinear, coincident, repeated
  for (const Metric metric : {Metric::kEdges, Metric::kUnfolded}) {
    const auto field = geodesic::distances_from(graph_of(mesh, metric), 0);
    CHECK(field[2] == doctest::Approx(2.0));
    CHECK(std::isfinite(field[3]));
  }
  mesh.positions[1] = {std::nan(""), 0, 0};
  for (const float d : geodesic::distances_from(graph_of(mesh, Metric::kUnfolded), 0)) CHECK(!std::isnan(d));
}

TEST_CASE("bridges join what the mesh does not") {
  const auto mesh = shapes::grid(2);
  const auto graph = graph_of(mesh, Metric::kEdges);
  const auto joined = geodesic::with_bridges(graph, {{0, 8, 0.1F}});
  CHECK(geodesic::distances_from(joined, 0)[8] == doctest::Approx(0.1));
  CHECK(geodesic::distances_from(joined, 0)[1] == geodesic::distances_from(graph, 0)[1]);
}
