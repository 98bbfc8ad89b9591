#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>

#include <bodice/synth/body.hpp>

#include "questions.hpp"

namespace fit_bench {
namespace {

using namespace bodice;

/// The time of a fit.
struct Row {
  double vertices = 0.0, ms = 0.0;
};

}  // namespace

bool print_growth(const engine::Context& context) {
  std::map<std::string, Row> first, last;
  double worst = 0.0;
  std::printf("vertices,tier,bytes,total_ms,power_since_row_before,power_since_first\n");
  for (const int vertices : {4500, 8850, 27000, 80000, 240000, 800000}) {
    synth::BodyOptions wanted;
    wanted.vertices = vertices;
    const auto body = synth::make_body(context, wanted);
    if (!body) return false;
    for (const char* const name : {"paper", "solid", "tight", "relief"}) {
      fitting::FitOptions options;
      options.tier = proxy::tier_from_name(name);
      options.max_ellipsoids = 89;
      options.measure_accuracy = false;
      const auto fitted = fitting::fit(context, {body->mesh, body->part, body->stature_m}, options);
      if (!fitted) return false;
      const Row row{static_cast<double>(body->mesh.positions.size()), total_ms(*fitted)};
      const auto power = [&](const Row& from) {
        return from.ms > 0.0 ? std::log(row.ms / from.ms) / std::log(row.vertices / from.vertices) : 0.0;
      };
      first.emplace(name, row);
      const double since_first = row.vertices > first[name].vertices ? power(first[name]) : 0.0;
      std::printf("%.0f,%s,%zu,%.1f,%.2f,%.2f\n", row.vertices, name, fitted->proxy.bytes(), row.ms,
                  power(last[name]), since_first);
      if (row.vertices > 10.0 * first[name].vertices) worst = std::max(worst, since_first);
      std::fflush(stdout);
      last[name] = row;
    }
  }
  std::printf(
      "# over more than ten times the vertices, time grows as a power of them of at most %.2f (bar: 1)\n",
      worst);
  return true;
}

}  // namespace fit_bench
