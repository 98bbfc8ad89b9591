// A sweep: one choice, or a few that belong together, over all values.
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <bench_support/plot.hpp>
#include <bench_support/table.hpp>

#include "bodies.hpp"

namespace tradeoff {

/// How many values and bodies a sweep takes.
enum class Effort { kSmallest, kQuick, kFull };

/// The input of every sweep.
struct Setting {
  bodice::engine::Context context;
  Effort effort = Effort::kFull;
  std::filesystem::path data;  ///< folder of bodies; may be empty
  int most_bodies = 1000;      ///< the most made bodies of a sweep

  template <class T>
  T by_effort(T smallest, T quick, T full) const {
    return effort == Effort::kSmallest ? smallest : effort == Effort::kQuick ? quick : full;
  }
  int bodies(int smallest, int quick, int full) const {
    return std::min(most_bodies, by_effort(smallest, quick, full));
  }
  int vertices() const { return by_effort(1500, 3000, 8850); }
};

/// The results of a sweep, which become a chapter of the page, CSV files and plots.
struct Findings {
  std::string text;                                        ///< Markdown: how the numbers were measured
  std::vector<bench::Table> shown;                         ///< tables in the page and as CSV
  std::vector<bench::Table> details;                       ///< tables as CSV only
  std::vector<std::pair<std::string, bench::Plot>> plots;  ///< with their file names, without extension
};

/// A sweep by its name.
struct Sweep {
  const char* name;
  const char* title;
  Findings (*run)(const Setting&);
};

/// Writes the progress of long work to standard error.
void progress(const char* what, const std::string& detail);

Findings sweep_front(const Setting& setting);
Findings sweep_targets(const Setting& setting);
Findings sweep_cost_model(const Setting& setting);
Findings sweep_regions(const Setting& setting);
Findings sweep_drapes(const Setting& setting);
Findings sweep_geodesics(const Setting& setting);
Findings sweep_stops(const Setting& setting);
Findings sweep_precision(const Setting& setting);

}  // namespace tradeoff
