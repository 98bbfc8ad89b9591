#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "long_run.hpp"

namespace bench {

/// The long runs that are wanted.
struct MovingOptions {
  std::filesystem::path data;  ///< empty: made bodies and garments
  std::string only;            ///< only outfits with this text in their names
  std::vector<std::string> motions;
  std::filesystem::path out;  ///< folder for a sheet a run and the depths of all frames; empty: none
  LongRunOptions run;
};

/// Prints a row for each outfit and motion under its bars; false if a file cannot be written.
bool drape_moving(const bodice::engine::Context& context, MovingOptions options);

}  // namespace bench
