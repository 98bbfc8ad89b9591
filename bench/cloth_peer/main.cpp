// The same sheet on the same ball, one worker, 8 substeps: bodice's cloth and Bullet's soft body in one run.
#include <benchmark/benchmark.h>

#include <bodice/cloth/solver.hpp>

#include "bullet_sheet.hpp"
#include "scene.hpp"

using namespace bodice;

namespace {

collision::Collider ball() {
  proxy::BodyProxy::Data data;
  data.stature_m = 1.7;
  proxy::ProxyEllipsoid e;
  e.shape.center = bench::kCenter;
  e.shape.radii = geometry::Vec3::Constant(bench::kRadius_m);
  data.ellipsoids.push_back(e);
  return collision::Collider(*proxy::BodyProxy::make(std::move(data)));
}

void report(benchmark::State& state, const geometry::TriMesh& mesh,
            const std::vector<geometry::Vec3>& positions) {
  state.counters["stretch_p95_percent"] = 1e2 * bench::stretch_p95(mesh, positions);
  state.counters["mm_deep"] = 1e3 * bench::deepest_m(positions);
}

void bodice_frame(benchmark::State& state, bool self_collision) {
  const geometry::TriMesh mesh = bench::sheet(static_cast<int>(state.range(0)));
  const collision::Collider body = ball();
  const engine::Context context;
  cloth::SolverOptions options{.substeps = bench::kSubsteps, .thickness_m = bench::kThickness_m};
  options.self_collision = self_collision;
  auto solver = cloth::Solver::make(mesh, {}, *cloth::find_fabric("cotton"), options);
  for (int k = 0; k < bench::kWarmFrames; ++k) solver->step(context, body, bench::kFrame_s);
  for (auto _ : state) solver->step(context, body, bench::kFrame_s);
  std::vector<geometry::Vec3> positions(mesh.positions.size());
  solver->positions(positions);
  report(state, mesh, positions);
}

void bullet_frame(benchmark::State& state) {
  const geometry::TriMesh mesh = bench::sheet(static_cast<int>(state.range(0)));
  bench::BulletSheet sheet(mesh);
  for (int k = 0; k < bench::kWarmFrames; ++k) sheet.step();
  for (auto _ : state) sheet.step();
  report(state, mesh, sheet.positions());
}

}  // namespace

// Bullet's sheet has no self-contact: compare it with the row no_layers, in which ours has none either.
BENCHMARK_CAPTURE(bodice_frame, layers, true)
    ->Arg(50)
    ->Arg(100)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(20);
BENCHMARK_CAPTURE(bodice_frame, no_layers, false)
    ->Arg(50)
    ->Arg(100)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(20);
BENCHMARK(bullet_frame)->Arg(50)->Arg(100)->Unit(benchmark::kMillisecond)->Iterations(20);

BENCHMARK_MAIN();
