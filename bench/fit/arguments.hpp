// The command line of bench/fit.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <bodice/proxy/body_proxy.hpp>

namespace fit_bench {

/// What to fit, and which question to answer.
struct Arguments {
  std::filesystem::path data;                               ///< folder of bodies with labels
  std::vector<bodice::proxy::Tier> tiers;                   ///< never empty
  std::vector<int> counts = {8, 16, 32, 55, 89, 200, 400};  ///< numbers of ellipsoids
  std::vector<std::string> bodies;                          ///< names of bodies in `data`
  std::vector<int> seeds;                                   ///< seeds of made bodies
  std::vector<double> targets_mm, budgets_us;
  std::filesystem::path svg;
  int threads = 2;
  double seconds = 2.0;  ///< time budget of each fit
  bool bars = false, gap_formula = false, anytime = false, growth = false;
};

/// Reads the command line. Ends the program with a message on a wrong option or --help.
Arguments read_arguments(int argc, char** argv);

}  // namespace fit_bench
