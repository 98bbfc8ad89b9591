// What does a better distance cost? Time of one distance field by method and queue on a made body of 13,000
// vertices, and its error against exact polyhedral distances. The time of a whole analysis is in
// bench/anatomy --cost. Bars: edges 4 % mean error; unfolded 1.7 % for 0.7 to 1.3 times the time of edges,
// fast marching 0.56 % for 4.8 times; the bucket queue 0.37 of a heap's time. Compare times within one run on
// a quiet machine only.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

#include <benchmark/benchmark.h>

#include <bodice/geodesic/distance_by_heap.hpp>
#include <bodice/geodesic/distance_solver.hpp>
#include <bodice/synth/body.hpp>

#include <bench_references/exact_geodesic.hpp>

namespace {

using namespace bodice;
using geodesic::Metric;

geometry::TriMesh body_mesh(int vertices) {
  synth::BodyOptions options;
  options.vertices = vertices;
  return synth::make_body({}, options).value().mesh;
}

constexpr int kBody = 13000;
constexpr std::array<geometry::Index, 4> kSources{0, 2500, 7000, 11000};

/// A body with exact distances, the reference for all errors.
struct Yardstick {
  geometry::TriMesh mesh;
  geometry::MeshEdges edges;
  std::vector<std::vector<double>> exact;
  double exact_ms = 0.0;  ///< time of the exact distances from one source
};

/// The yardstick, computed at the first call.
const Yardstick& yardstick() {
  static const Yardstick made = [] {
    Yardstick y{body_mesh(kBody), {}, {}, 0.0};
    y.edges = geometry::mesh_edges(y.mesh);
    const auto begin = std::chrono::steady_clock::now();
    for (const geometry::Index source : kSources)
      y.exact.push_back(bench::exact_distances(y.mesh, y.edges, source));
    y.exact_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count() /
                 kSources.size();
    return y;
  }();
  return made;
}

/// Reports the mean and the largest relative error against exact polyhedral distances, at vertices farther
/// than a twentieth of the largest distance.
void count_error(benchmark::State& state, const geodesic::DistanceSolver& solver) {
  const Yardstick& y = yardstick();
  double sum = 0.0, worst = 0.0;
  std::size_t count = 0;
  for (std::size_t s = 0; s < kSources.size(); ++s) {
    const auto field = solver.distances_from(kSources[s]);
    const double near = 0.05 * *std::max_element(y.exact[s].begin(), y.exact[s].end());
    for (std::size_t v = 0; v < field.size(); ++v) {
      if (y.exact[s][v] < near) continue;
      const double error = std::abs(static_cast<double>(field[v]) / y.exact[s][v] - 1.0);
      sum += error;
      worst = std::max(worst, error);
      ++count;
    }
  }
  state.counters["mean_%"] = 100.0 * sum / static_cast<double>(count);
  state.counters["max_%"] = 100.0 * worst;
}

void method(benchmark::State& state, geodesic::Method method) {
  const Yardstick& y = yardstick();
  const geodesic::DistanceSolver solver({}, y.mesh, y.edges, method);
  for (auto _ : state) benchmark::DoNotOptimize(solver.distances_from(0));
  count_error(state, solver);
}

void binary_heap(benchmark::State& state, Metric metric) {
  const Yardstick& y = yardstick();
  const auto graph = geodesic::edge_graph({}, y.mesh, y.edges, metric);
  const geodesic::Seed seed{0, 0.0F};
  for (auto _ : state) benchmark::DoNotOptimize(geodesic::distances_by_heap(graph, {&seed, 1}));
}

void building(benchmark::State& state, Metric metric) {
  const Yardstick& y = yardstick();
  for (auto _ : state)
    benchmark::DoNotOptimize(geodesic::edge_graph({}, y.mesh, geometry::mesh_edges(y.mesh), metric).mean);
}

/// The time of the exact distances, as measured when the yardstick was computed.
void exact(benchmark::State& state) {
  for (auto _ : state) state.SetIterationTime(1e-3 * yardstick().exact_ms);
}

}  // namespace

BENCHMARK_CAPTURE(method, edges, geodesic::Method::kEdges)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(method, unfolded, geodesic::Method::kUnfolded)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(method, fast_marching, geodesic::Method::kFastMarching)->Unit(benchmark::kMillisecond);
BENCHMARK(exact)->Unit(benchmark::kMillisecond)->UseManualTime()->Iterations(1);
BENCHMARK_CAPTURE(binary_heap, edges, Metric::kEdges)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(binary_heap, unfolded, Metric::kUnfolded)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(building, edges, Metric::kEdges)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(building, unfolded, Metric::kUnfolded)->Unit(benchmark::kMillisecond);

BENCHMARK_MAIN();
