#include "cost.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <string>

#include <bodice/anatomy/anatomy.hpp>

#include "cases.hpp"

namespace bench {
namespace {

namespace engine = bodice::engine;
using bodice::geometry::TriMesh;

constexpr int kPaperSize = 8850;
constexpr double kBar_ms = 15.0;

struct Cost {
  double total_ms = std::numeric_limits<double>::infinity();
  std::map<std::string, double> stage_ms;  ///< of the fastest run
};

/// The fastest of some runs: what disturbs a run only ever adds to it.
Cost fastest(const engine::Context& context, const TriMesh& mesh, int runs) {
  const bodice::anatomy::Options options{*bodice::body::find_profile("ansur2")};
  Cost best;
  for (int run = 0; run < runs; ++run) {
    const auto start = context.clock->now_ns();
    const auto found = bodice::anatomy::analyze(context, mesh, options);
    const double ms = 1e-6 * static_cast<double>(context.clock->now_ns() - start);
    if (!found || ms >= best.total_ms) continue;
    best.total_ms = ms;
    best.stage_ms.clear();
    for (const auto& stage : found->stages) best.stage_ms[stage.name] = stage.ms;
  }
  return best;
}

void print_paper_size(const engine::Context& context, int workers) {
  const TriMesh mesh = synth_mesh(kPaperSize);
  const Cost cost = fastest(context, mesh, 40);
  std::printf("%zu vertices, %d worker%s: %6.2f ms (bar on two: %.0f)", mesh.positions.size(), workers,
              workers == 1 ? " " : "s", cost.total_ms, kBar_ms);
  for (const auto& [name, ms] : cost.stage_ms) std::printf("  %s %.2f", name.c_str(), ms);
  std::printf("\n");
}

void print_growth(const engine::Context& context) {
  std::printf("%9s %10s %16s %14s\n", "vertices", "ms", "ns / (n log2 n)", "of the least");
  double first = 0.0;
  for (const int vertices : {3000, 8850, 25000, 75000, 200000, 400000, 800000}) {
    const TriMesh mesh = synth_mesh(vertices);
    if (mesh.empty()) continue;
    const auto n = static_cast<double>(mesh.positions.size());
    const Cost cost = fastest(context, mesh, vertices < 100000 ? 12 : 1);
    const double unit = 1e6 * cost.total_ms / (n * std::log2(n));
    first = first > 0.0 ? first : unit;
    std::printf("%9zu %10.2f %16.2f %14.2f\n", mesh.positions.size(), cost.total_ms, unit, unit / first);
  }
}

}  // namespace

void print_cost() {
  print_paper_size({}, 1);
  const auto two = engine::make_tbb_executor(2);
  engine::Context context;
  context.executor = two.get();
  print_paper_size(context, 2);
  print_growth(context);
}

}  // namespace bench
