// The numbers of all bodies and motions: tables with their bars, JSON, and a plot.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "costs.hpp"
#include "judge.hpp"

namespace bench {

/// One method on one clip.
struct MethodResult {
  std::string name;
  Judge judge;
  PeerCost cost;
  double bytes = 0.0;
  bool knows_depth = true;
  std::vector<double> time_s;  ///< time of each frame that was judged
};

/// One clip of one body. The first method is the carried proxy, the second one the refitted.
struct MotionResult {
  std::string body, motion;
  std::vector<MethodResult> methods;
  ProxyCost cost;
  double refit_ms = 0.0;  ///< processor time of one refit, median
};

/// What was measured of one body besides.
struct BodyResult {
  std::string body;
  std::size_t vertices = 0, ellipsoids = 0;
  double bind_ms = 0.0;  ///< processor time on top of the fit
  double proxy_bytes = 0.0, binding_bytes = 0.0;
};

void print_motion(const MotionResult& result);
/// The table of numbers that a body in motion is judged by, each with its bar.
void print_bars(const std::vector<BodyResult>& bodies, const std::vector<MotionResult>& motions);
bool write_json(const std::vector<BodyResult>& bodies, const std::vector<MotionResult>& motions,
                const std::filesystem::path& file);
bool write_plot(const std::vector<MotionResult>& motions, const std::filesystem::path& png);

}  // namespace bench
