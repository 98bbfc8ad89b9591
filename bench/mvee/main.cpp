#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include <bodice/engine/random.hpp>
#include <bodice/fitting/mvee.hpp>

#include "cgal_mvee.hpp"

namespace {

using bodice::geometry::Vec3;

/// Points of a Gaussian cloud or of an ellipsoid's surface, the hard case, where every point may touch.
std::vector<Vec3> cloud(std::int64_t count, bool on_sphere) {
  bodice::engine::Random random(9);
  std::vector<Vec3> points;
  for (std::int64_t i = 0; i < count; ++i) {
    Vec3 p(random.normal(), random.normal(), random.normal());
    if (on_sphere) p.normalize();
    points.push_back(p.cwiseProduct(Vec3(0.2, 0.1, 0.08)));
  }
  return points;
}

void exact(benchmark::State& state) {
  const auto points = cloud(state.range(0), state.range(1) != 0);
  double gap = 0.0;
  for (auto _ : state) gap = bodice::fitting::mvee(points).volume_gap;
  state.counters["volume_gap"] = gap;
}

void first_order(benchmark::State& state) {
  const auto points = cloud(state.range(0), state.range(1) != 0);
  double gap = 0.0;
  for (auto _ : state) gap = bodice::fitting::mvee_first_order(points, 1e-3).volume_gap;
  state.counters["volume_gap"] = gap;
}

#ifdef BENCH_CGAL
void cgal(benchmark::State& state) {
  const auto points = cloud(state.range(0), state.range(1) != 0);
  const double least = bodice::geometry::volume(bodice::fitting::mvee(points).ellipsoid);
  double volume = 0.0;
  for (auto _ : state) volume = mvee_bench::cgal_volume(points, 0.01);
  state.counters["volume_gap"] = std::log(volume / least);
}
BENCHMARK(cgal)->ArgsProduct({{10, 100, 1000, 10000}, {0, 1}})->Unit(benchmark::kMicrosecond);
#endif

}  // namespace

BENCHMARK(exact)->ArgsProduct({{10, 100, 1000, 10000, 100000}, {0, 1}})->Unit(benchmark::kMicrosecond);
BENCHMARK(first_order)->ArgsProduct({{10, 100, 1000, 10000, 100000}, {0, 1}})->Unit(benchmark::kMicrosecond);
BENCHMARK_MAIN();
