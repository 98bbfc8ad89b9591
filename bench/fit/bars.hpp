// What each tier promises beside the worst that was measured.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include <bodice/fitting/fit.hpp>

#include <bench_references/near_skin.hpp>

namespace fit_bench {

inline constexpr double kTimedVertices = 8850.0;

/// Milliseconds of a stage of the fit, by its name.
double stage_ms(const bodice::fitting::FitResult& result, std::string_view name);

/// Collects fits at 89 ellipsoids; each measure keeps its worst body.
class Bars {
 public:
  /// `kind` is a tier's name, or "covering"; `ms` is what its stage took. The bars of time are those of
  /// kTimedVertices: a larger body, whose time may grow with its vertices, has as many times as long.
  void note(const std::string& body, const std::string& kind, const bodice::fitting::FitResult& result,
            const bench::NearSkin& near, double ms, std::size_t vertices);
  /// CSV: kind, measure, bar (at most), mean over the bodies, worst, worst body, bodies that miss it.
  void print() const;
  /// Bars that some body misses.
  int missed() const;

 private:
  struct Line {
    double bar = 0.0, sum = 0.0, worst = 0.0;
    int bodies = 0, missed = 0;
    std::string worst_body;
  };
  void at_most(const std::string& kind, const std::string& measure, double bar, double value,
               const std::string& body);

  std::map<std::pair<std::string, std::string>, Line> lines_;
};

}  // namespace fit_bench
