// Rows of the table: what is timed, what it took, and how far off the answers are.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace bench {

inline constexpr double kBand_m = 0.03;  ///< particles are so near to the skin

struct Row {
  std::string name;
  std::function<void()> work;
  double particles;
  double bar = 0.0;                       ///< what it must not exceed, ns; zero: none of its own
  std::function<void()> prepare = [] {};  ///< before each call, not timed
  int calls = 1;                          ///< a repeat, which counts their mean
  std::vector<double> ns = {};            ///< a particle, one a repeat

  double median() const { return ns[ns.size() / 2]; }
  double least() const { return ns.front(); }
};

/// What a workspace keeps serves about ten calls: a repeat has so many that finding it anew counts, too.
inline constexpr int kFrameCalls = 20;

/// Times every row `repeats` times, in turns; each row's times come out sorted.
void measure(std::vector<Row>& rows, int repeats);

/// Throws std::logic_error if there is none of this name.
const Row& row_of(const std::vector<Row>& rows, const std::string& name);

/// Mean and 95th percentile of | |found| - |truth| |, mm, where the truth is within reach.
std::string error_of(const std::vector<float>& found, const std::vector<double>& truth, bool with_sign,
                     double reach_m = kBand_m);

}  // namespace bench
