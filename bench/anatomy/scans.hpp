// How are scans and game files read? Outcomes by kind of scan, beside the truth that synth knows.
#pragma once

#include <cstdint>
#include <string>

namespace bench {

/// Makes `count` scans of each kind, of seeds `from` on, reads them as files and analyzes them. Prints a row
/// a kind: right, right with doubts, wrong with a warning, refused, silently wrong, absurd. `only`: a part
/// of the kind's name. `verbose`: a line a scan. `folder`: keeps the files there.
struct ScanBench {
  std::uint64_t count = 3, from = 0;
  std::string only = {}, folder = {};
  bool verbose = false;
};
void print_scans(const ScanBench& bench);

}  // namespace bench
