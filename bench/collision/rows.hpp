// Rows of the table: what is timed, how long it took, and how far off the results are.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace bench {

inline constexpr double kBand_m = 0.03;  ///< largest distance of the particles from the skin

/// One row of the table: what is timed, and its times.
struct Row {
  std::string name;
  std::function<void()> work;
  double particles;
  double bar = 0.0;                       ///< largest allowed time, ns; zero: no bar of its own
  std::function<void()> prepare = [] {};  ///< runs before each call, not timed
  int calls = 1;                          ///< calls in a repeat, of which the mean counts
  std::vector<double> ns = {};            ///< a particle; one value a repeat

  double median() const { return ns[ns.size() / 2]; }
  double least() const { return ns.front(); }
};

/// Cached candidates serve about ten calls; a repeat has enough calls to include searches for new ones.
inline constexpr int kFrameCalls = 20;

/// Times every row `repeats` times, in turns; each row's times come out sorted.
void measure(std::vector<Row>& rows, int repeats);

/// The row of this name; throws std::logic_error if there is none.
const Row& row_of(const std::vector<Row>& rows, const std::string& name);

/// Mean and 95th percentile of | |found| - |truth| |, mm, where the truth is within reach.
std::string error_of(const std::vector<float>& found, const std::vector<double>& truth, bool with_sign,
                     double reach_m = kBand_m);

}  // namespace bench
