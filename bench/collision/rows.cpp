#include "rows.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include <bench_support/stopwatch.hpp>

namespace bench {

void measure(std::vector<Row>& rows, int repeats) {
  for (Row& row : rows) row.work();
  for (int r = 0; r < repeats; ++r)
    for (Row& row : rows) {
      row.prepare();
      row.work();  // the row before has filled the caches with its own data
      double ms = 0.0;
      for (int call = 0; call < row.calls; ++call) {
        row.prepare();
        const Stopwatch watch;
        row.work();
        ms += watch.cpu_ms();
      }
      row.ns.push_back(1e6 * ms / (row.particles * row.calls));
    }
  for (Row& row : rows) std::sort(row.ns.begin(), row.ns.end());
}

std::string error_of(const std::vector<float>& found, const std::vector<double>& truth, bool with_sign,
                     double reach_m) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const double value = static_cast<double>(found[i]);
    if (std::abs(truth[i]) > reach_m) continue;
    errors.push_back(1e3 * std::abs(with_sign ? value - truth[i] : std::abs(value) - std::abs(truth[i])));
  }
  std::sort(errors.begin(), errors.end());
  double sum = 0.0;
  for (const double e : errors) sum += e;
  char text[64];
  std::snprintf(text, sizeof(text), "%.2f / %.2f", sum / static_cast<double>(errors.size()),
                errors[errors.size() * 95 / 100]);
  return text;
}

const Row& row_of(const std::vector<Row>& rows, const std::string& name) {
  const auto row = std::find_if(rows.begin(), rows.end(), [&](const Row& r) { return r.name == name; });
  if (row == rows.end()) throw std::logic_error("no row " + name);
  return *row;
}

}  // namespace bench
