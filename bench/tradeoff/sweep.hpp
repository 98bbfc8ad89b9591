// A sweep: one dial, or a few that belong together, turned through its range.
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <bench_support/plot.hpp>
#include <bench_support/table.hpp>

#include "bodies.hpp"

namespace tradeoff {

enum class Effort { kSmallest, kQuick, kFull };

/// What every sweep is given.
struct Setting {
  bodice::engine::Context context;
  Effort effort = Effort::kFull;
  std::filesystem::path data;  ///< folder of bodies; may be empty
  int most_bodies = 1000;      ///< made ones, a sweep

  template <class T>
  T by_effort(T smallest, T quick, T full) const {
    return effort == Effort::kSmallest ? smallest : effort == Effort::kQuick ? quick : full;
  }
  int bodies(int smallest, int quick, int full) const {
    return std::min(most_bodies, by_effort(smallest, quick, full));
  }
  int vertices() const { return by_effort(1500, 3000, 8850); }
};

/// What it found: a chapter of the page, tables that become CSV files as well, plots.
struct Findings {
  std::string text;                   ///< Markdown: how it was measured, and what it says
  std::vector<bench::Table> shown;    ///< in the page and as CSV
  std::vector<bench::Table> details;  ///< as CSV only
  std::vector<std::pair<std::string, bench::Plot>> plots;  ///< by file name, without its ending
};

struct Sweep {
  const char* name;
  const char* title;
  Findings (*run)(const Setting&);
};

/// Tells standard error where long work stands.
void progress(const char* what, const std::string& detail);

Findings sweep_front(const Setting& setting);
Findings sweep_dials(const Setting& setting);
Findings sweep_laws(const Setting& setting);
Findings sweep_regions(const Setting& setting);
Findings sweep_drapes(const Setting& setting);
Findings sweep_geodesics(const Setting& setting);
Findings sweep_stops(const Setting& setting);
Findings sweep_precision(const Setting& setting);

}  // namespace tradeoff
