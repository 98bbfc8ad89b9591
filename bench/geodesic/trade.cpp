// Time of the distance field by metric and queue, its error on a sphere (where the truth is an arc), and time
// and growth of the whole analysis. Run it on a quiet machine; ratios within one run are what counts.
#include <algorithm>
#include <cmath>

#include <benchmark/benchmark.h>

#include <bodice/anatomy/anatomy.hpp>
#include <bodice/geodesic/distance.hpp>
#include <bodice/synth/body.hpp>

namespace {

using namespace bodice;
using geodesic::Metric;

geometry::TriMesh body_mesh(int vertices) {
  synth::BodyOptions options;
  options.vertices = vertices;
  return synth::make_body({}, options).value().mesh;
}

/// Latitude-longitude sphere with quads cut alternately: a mesh without preferred diagonals.
geometry::TriMesh sphere_mesh(int rings) {
  geometry::TriMesh mesh;
  const int around = 2 * rings;
  mesh.positions.emplace_back(0, 0, 1);
  for (int i = 1; i < rings; ++i)
    for (int j = 0; j < around; ++j) {
      const double polar = M_PI * i / rings, turn = 2.0 * M_PI * j / around;
      mesh.positions.emplace_back(std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn),
                                  std::cos(polar));
    }
  mesh.positions.emplace_back(0, 0, -1);
  const auto at = [&](int i, int j) {
    return static_cast<geometry::Index>(1 + (i - 1) * around + j % around);
  };
  const auto last = static_cast<geometry::Index>(mesh.positions.size() - 1);
  for (int j = 0; j < around; ++j) {
    mesh.triangles.push_back({0, at(1, j), at(1, j + 1)});
    mesh.triangles.push_back({last, at(rings - 1, j + 1), at(rings - 1, j)});
    for (int i = 1; i + 1 < rings; ++i)
      if ((i + j) % 2 == 0) {
        mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
        mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
      } else {
        mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
        mesh.triangles.push_back({at(i, j + 1), at(i + 1, j), at(i + 1, j + 1)});
      }
  }
  return mesh;
}

/// Mean and worst relative error, beyond a tenth of the way round, from the pole and from the equator.
void count_error(benchmark::State& state, Metric metric) {
  const auto mesh = sphere_mesh(60);
  const auto graph = geodesic::edge_graph({}, mesh, geodesic::mesh_edges(mesh), metric);
  double sum = 0.0, worst = 0.0;
  int count = 0;
  for (const geometry::Index source : {geometry::Index{0}, geometry::Index{3541}, geometry::Index{1777}}) {
    const auto field = geodesic::distances_from(graph, source);
    for (std::size_t v = 0; v < field.size(); ++v) {
      const double truth = std::acos(std::clamp(mesh.positions[v].dot(mesh.positions[source]), -1.0, 1.0));
      if (truth < 0.3) continue;
      const double error = std::abs(static_cast<double>(field[v]) / truth - 1.0);
      sum += error;
      worst = std::max(worst, error);
      ++count;
    }
  }
  state.counters["sphere_mean_%"] = 100.0 * sum / count;
  state.counters["sphere_max_%"] = 100.0 * worst;
}

void bucket_queue(benchmark::State& state, Metric metric) {
  const auto mesh = body_mesh(static_cast<int>(state.range(0)));
  const auto graph = geodesic::edge_graph({}, mesh, geodesic::mesh_edges(mesh), metric);
  for (auto _ : state) benchmark::DoNotOptimize(geodesic::distances_from(graph, 0));
  count_error(state, metric);
}

void binary_heap(benchmark::State& state, Metric metric) {
  const auto mesh = body_mesh(static_cast<int>(state.range(0)));
  const auto graph = geodesic::edge_graph({}, mesh, geodesic::mesh_edges(mesh), metric);
  const geodesic::Seed seed{0, 0.0F};
  for (auto _ : state) benchmark::DoNotOptimize(geodesic::distances_by_heap(graph, {&seed, 1}));
}

void building(benchmark::State& state, Metric metric) {
  const auto mesh = body_mesh(static_cast<int>(state.range(0)));
  for (auto _ : state)
    benchmark::DoNotOptimize(geodesic::edge_graph({}, mesh, geodesic::mesh_edges(mesh), metric).mean);
}

/// Geodesics, landmarks and segmentation together.
void analysis(benchmark::State& state) {
  const auto mesh = body_mesh(static_cast<int>(state.range(0)));
  const auto executor = engine::make_tbb_executor(static_cast<int>(state.range(1)));
  engine::Context context;
  context.executor = executor.get();
  for (auto _ : state) benchmark::DoNotOptimize(anatomy::analyse(context, mesh, {}).ok());
  const auto n = static_cast<double>(mesh.positions.size());
  state.counters["vertices"] = n;
  state.counters["per_n_log2_n"] = benchmark::Counter(
      n * std::log2(n), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

}  // namespace

BENCHMARK_CAPTURE(bucket_queue, edges, Metric::kEdges)->Arg(13000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(bucket_queue, unfolded, Metric::kUnfolded)->Arg(13000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(binary_heap, edges, Metric::kEdges)->Arg(13000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(binary_heap, unfolded, Metric::kUnfolded)->Arg(13000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(building, edges, Metric::kEdges)->Arg(13000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(building, unfolded, Metric::kUnfolded)->Arg(13000)->Unit(benchmark::kMillisecond);
BENCHMARK(analysis)
    ->ArgsProduct({{8850}, {1, 2}})
    ->ArgsProduct({{50000, 200000, 800000}, {2}})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

BENCHMARK_MAIN();
