#pragma once

#include <optional>
#include <string>
#include <vector>

#include <bodice/tryon/drape.hpp>
#include <bodice/tryon/prepare.hpp>

namespace bodice::tryon {

/// What a report tells of its run, so that it can be repeated.
struct RunInfo {
  int threads = 1;
  std::uint64_t seed = 0;
  std::string program;               ///< name and version
  std::vector<std::string> command;  ///< as it was typed, word by word
  /// The proxy was cut down after it was measured (within_reach): the accuracy is the whole body's.
  bool cropped = false;
};

/// What came out, as one JSON object, indented. Positions in the input's units and axes. README.md explains
/// its fields.
std::string report_json(const PreparedBody& body, const DrapeReport* drape, const RunInfo& run);

/// One line a welded vertex, `x y z part`, in the input's units and axes.
std::string labels_text(const SegmentedSkin& skin);

}  // namespace bodice::tryon
