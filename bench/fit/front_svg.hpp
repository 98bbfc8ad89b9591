// The trade between ellipsoids and error as a picture.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace fit_bench {

struct FrontPoint {
  std::string tier;
  double ellipsoids = 0.0, error_mm = 0.0;
};

/// One line a tier over logarithmic axes; where a tier has several bodies at a count, their geometric mean.
/// False if the file cannot be written.
bool write_front_svg(const std::filesystem::path& file, const std::vector<FrontPoint>& points);

}  // namespace fit_bench
