#pragma once

#include <cstdio>
#include <cstring>

namespace bench {

/// Prints `usage` and returns true where --help or -h is among the arguments.
inline bool help_requested(int argc, char** argv, const char* usage) {
  for (int i = 1; i < argc; ++i)
    if (std::strcmp(argv[i], "--help") == 0 || std::strcmp(argv[i], "-h") == 0) {
      std::fputs(usage, stdout);
      return true;
    }
  return false;
}

}  // namespace bench
