// The bars of each tier, which are its promises, beside the worst value that was measured.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include <bodice/fitting/fit.hpp>

#include <bench_references/near_skin.hpp>

namespace fit_bench {

/// Bars of time hold for bodies of this many vertices.
inline constexpr double kTimedVertices = 8850.0;

/// Collects fits with 89 ellipsoids, and keeps the worst body of each measure.
class Bars {
 public:
  /// Adds a fit. `kind` is a tier's name, or "covering"; `ms` is the time of its stage. For a body with more
  /// vertices than kTimedVertices the time is divided by the ratio, because it may grow with the vertices.
  void note(const std::string& body, const std::string& kind, const bodice::fitting::FitResult& result,
            const bench::NearSkin& near, double ms, std::size_t vertices);
  /// Prints CSV: kind, measure, bar (at most), mean over the bodies, worst, worst body, number of misses, of
  /// bodies.
  void print() const;
  /// The number of bars that some body misses.
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
