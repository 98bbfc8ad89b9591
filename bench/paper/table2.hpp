// The paper's Table 2: four bodies, segmented and fitted, beside the stand-in for its [19].
#pragma once

#include <span>
#include <string>
#include <vector>

#include <bench_support/table.hpp>
#include <bodice/engine/result.hpp>

#include "bodies.hpp"
#include "judge.hpp"

namespace paper_bench {

/// One method on one body.
struct MethodResult {
  std::string method;
  std::size_t ellipsoids = 0;
  double segment_ms = 0.0, fit_ms = 0.0;  ///< processor time; for bodice the least of the repeats
  int backtracks = 0;                     ///< splits taken back; only the stand-in has them
  Approximation approximation;
};

/// One body with all methods.
struct Table2Row {
  PaperRow paper;
  std::string source;
  std::size_t vertices = 0;
  std::vector<MethodResult> methods;  ///< bodice, the stand-in, the stand-in without taking splits back
};

/// How often a method is timed, and how finely its result is measured.
struct Effort {
  int repeats = 3;
  std::size_t samples = 20000;  ///< number of samples of the Judge
};

/// Runs every method with as many ellipsoids as the paper has, on one thread.
bodice::engine::Result<Table2Row> measure_table2(const Subject& subject, const Effort& effort);

/// Two tables: times beside the paper's, and the approximation.
std::vector<bench::Table> table2(std::span<const Table2Row> rows);

}  // namespace paper_bench
