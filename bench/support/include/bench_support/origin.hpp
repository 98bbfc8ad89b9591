#pragma once

#include <string>

namespace bench {

/// Commit, compiler and machine of a measurement.
struct Origin {
  std::string commit, compiler, flags, cpu;
  unsigned hardware_threads = 0;
};

Origin find_origin();

/// The origin in one line, for titles: commit, compiler, processor.
std::string title(const Origin& origin);

}  // namespace bench
