// How are scans and game files read? Outcomes by kind of scan, beside the truth that synth knows.
#pragma once

#include <cstdint>
#include <string>

namespace bench {

/// Makes `count` scans of each kind, of seeds `from` on, reads them as files and analyzes them. Prints a row
/// a kind: right, right with doubts, wrong with a warning, refused, silently wrong, absurd.
struct ScanBench {
  std::uint64_t count = 3, from = 0;
  std::string only = {};    ///< text that the names of the kinds must hold
  std::string folder = {};  ///< where the files are kept; empty: they are not
  bool verbose = false;     ///< whether each scan has a line of its own
};
void print_scans(const ScanBench& bench);

}  // namespace bench
