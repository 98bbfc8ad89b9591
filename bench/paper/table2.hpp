// The paper's Table 2: four bodies, segmented and fitted, beside the stand-in for its [19].
#pragma once

#include <span>
#include <string>
#include <vector>

#include <bodice/engine/result.hpp>

#include "bodies.hpp"
#include "judge.hpp"

namespace paper_bench {

struct MethodResult {
  std::size_t ellipsoids = 0;
  double segment_ms = 0.0, fit_ms = 0.0;  ///< processor time, least of the repeats
  Approximation approximation;
};

struct Table2Row {
  PaperRow paper;
  std::string source;
  std::size_t vertices = 0;
  MethodResult ours, rival;
  int rival_backtracks = 0, rival_iterations = 0;
  double mu_torso_mm = 0.0, mu_limbs_mm = 0.0;  ///< of ours, found from the count
};

struct Effort {
  int repeats = 3;
  std::size_t samples = 20000;  ///< of the judge
};

/// Both methods with as many ellipsoids as the paper has, on one thread.
bodice::engine::Result<Table2Row> measure_table2(const Subject& subject, const Effort& effort);

std::string table2_csv(std::span<const Table2Row> rows);
std::string table2_markdown(std::span<const Table2Row> rows);

}  // namespace paper_bench
