// Measures how scans and game files are read: outcomes by kind of scan, beside the truth that synth gives.
#pragma once

#include <cstdint>
#include <string>

namespace bench {

/// Makes `count` scans of each kind, of seeds `from` on, reads them as files and analyzes them. Prints a row
/// a kind: right, right with doubts, wrong with a warning, refused, silently wrong, absurd; the longest time
/// (with the judging), and the mean distance of the skin to the clean body.
struct ScanBench {
  std::uint64_t count = 3, from = 0;
  std::string only = {};     ///< text that the names of the kinds must hold
  std::string folder = {};   ///< where the files are kept; empty: they are not
  std::string data = {};     ///< the folder of real bodies to be scanned; empty: made ones are
  std::string picture = {};  ///< PNG of all bodies that were read, by part, with their landmarks
  bool verbose = false;      ///< whether each scan has a line of its own
  bool proxies = false;      ///< whether each scan is fitted, and the proxy measured against the clean body
};
/// Returns false if the picture could not be written.
bool print_scans(const ScanBench& bench);

}  // namespace bench
