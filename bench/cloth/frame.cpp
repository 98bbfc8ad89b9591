// What does a frame of cloth cost, by particles, substeps and workers, and what does it buy?
// body:0 steps the same garment without the body: the difference is what contact costs.
#include <benchmark/benchmark.h>

#include <cmath>

#include <bodice/cloth/solver.hpp>

using namespace bodice;

namespace {

constexpr double kFrame_s = 1.0 / 60.0;

// A torso of 9 by 10 ellipsoids: as many as a fitted body has.
collision::Collider torso() {
  proxy::BodyProxy::Data data;
  data.stature_m = 1.7;
  for (int ring = 0; ring < 9; ++ring) {
    for (int k = 0; k < 10; ++k) {
      const double angle = 0.6283185307179586 * k;
      proxy::ProxyEllipsoid e;
      e.shape.center = geometry::Vec3(0.10 * std::cos(angle), 0.9 + 0.07 * ring, 0.07 * std::sin(angle));
      e.shape.radii = geometry::Vec3(0.07, 0.08, 0.07);
      data.ellipsoids.push_back(e);
    }
  }
  return collision::Collider(*proxy::BodyProxy::make(std::move(data)));
}

// A poncho: a square sheet over the torso's top, side * side particles.
geometry::TriMesh poncho(int side) {
  geometry::TriMesh mesh;
  for (int j = 0; j < side; ++j) {
    for (int i = 0; i < side; ++i) {
      mesh.positions.emplace_back(1.2 * i / (side - 1) - 0.6, 1.55, 1.2 * j / (side - 1) - 0.6);
    }
  }
  for (int j = 0; j + 1 < side; ++j) {
    for (int i = 0; i + 1 < side; ++i) {
      const auto a = static_cast<geometry::Index>(j * side + i), c = a + static_cast<geometry::Index>(side);
      mesh.triangles.push_back({a, c, a + 1});
      mesh.triangles.push_back({a + 1, c, c + 1});
    }
  }
  return mesh;
}

void frame(benchmark::State& state) {
  const int side = static_cast<int>(std::lround(std::sqrt(static_cast<double>(state.range(0)))));
  cloth::SolverOptions options;
  options.substeps = static_cast<int>(state.range(1));
  const auto executor = engine::make_tbb_executor(static_cast<int>(state.range(2)));
  const engine::Context context{.executor = executor.get()};
  const collision::Collider body = torso();
  const bool with_body = state.range(3) != 0;
  auto solver = cloth::Solver::make(poncho(side), {}, *cloth::find_fabric("cotton"), options);
  for (int k = 0; k < 30; ++k) solver->step(context, body, kFrame_s);  // in contact, folds begun
  cloth::FrameReport report;
  for (auto _ : state) {
    report = with_body ? solver->step(context, body, kFrame_s) : solver->step(context, kFrame_s);
  }
  state.counters["stretch_p95"] = report.stretch_p95;
  state.counters["asleep"] = static_cast<double>(report.asleep);
}

}  // namespace

BENCHMARK(frame)
    ->ArgNames({"particles", "substeps", "workers", "body"})
    ->ArgsProduct({{10'000}, {2, 4, 8, 16, 32}, {1, 2}, {1}})
    ->ArgsProduct({{10'000, 100'000}, {8}, {1, 2}, {0, 1}})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(20);

BENCHMARK_MAIN();
