#pragma once

#include <string>

namespace bench {

/// Where numbers come from.
struct Origin {
  std::string commit, compiler, flags, cpu;
  unsigned hardware_threads = 0;
};

Origin find_origin();

/// One line for titles: commit, compiler, processor.
std::string title(const Origin& origin);

}  // namespace bench
