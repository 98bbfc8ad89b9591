// The trade between ellipsoids and error as a picture.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace fit_bench {

/// The error of one fit.
struct FrontPoint {
  std::string tier;
  double ellipsoids = 0.0, error_mm = 0.0;
};

/// Draws a line for each tier over logarithmic axes, through the geometric means over bodies. False if the
/// file cannot be written.
bool write_front_svg(const std::filesystem::path& file, const std::vector<FrontPoint>& points);

}  // namespace fit_bench
