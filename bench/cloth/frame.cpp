// What does a frame of cloth cost, by particles, substeps and workers, and how much stretch is left?
// The program prints the bars first; with --benchmark_filter=none it ends after them, and with --walking it
// prints only that of a body that walks. Rows with body:0 step the same garment without the body, so that the
// difference is the cost of contact.
#include <string_view>

#include <benchmark/benchmark.h>

#include "bars.hpp"
#include "scene.hpp"
#include "walking.hpp"

using namespace bodice;

namespace {

constexpr double kFrame_s = 1.0 / 60.0;

void frame(benchmark::State& state) {
  cloth::SolverOptions options;
  options.substeps = static_cast<int>(state.range(1));
  const auto executor = engine::make_tbb_executor(static_cast<int>(state.range(2)));
  const engine::Context context{.executor = executor.get()};
  const collision::Collider body = bench::torso();
  const bool with_body = state.range(3) != 0;
  auto solver = cloth::Solver::make(bench::poncho(static_cast<std::size_t>(state.range(0))), {},
                                    *cloth::find_fabric("cotton"), options);
  for (int k = 0; k < 30; ++k) solver->step(context, body, kFrame_s);  // in contact, folds begun
  cloth::FrameReport report;
  for (auto _ : state) {
    report = with_body ? solver->step(context, body, kFrame_s) : solver->step(context, kFrame_s);
  }
  state.counters["stretch_p95"] = report.stretch_p95;
  state.counters["collision_%"] = 1e2 * report.collision_us / report.frame_us;
  state.counters["asleep"] = static_cast<double>(report.asleep);
}

}  // namespace

BENCHMARK(frame)
    ->ArgNames({"particles", "substeps", "workers", "body"})
    ->ArgsProduct({{10'000}, {2, 4, 8, 16, 32}, {1, 2}, {1}})
    ->ArgsProduct({{10'000, 100'000}, {8}, {1, 2}, {0, 1}})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(20);

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  const bool only_walking = argc > 1 && std::string_view(argv[1]) == "--walking";
  if (!only_walking) bench::print_bars();
  bench::print_walking();
  if (only_walking) return 0;
  benchmark::RunSpecifiedBenchmarks();
}
