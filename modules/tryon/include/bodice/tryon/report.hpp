// The report of a run as JSON, and the labels of a skin as text.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <bodice/tryon/drape.hpp>
#include <bodice/tryon/prepare.hpp>

namespace bodice::inline v0_1::tryon {

/// The run that a report is about, so that it can be repeated.
struct RunInfo {
  int threads = 1;
  std::uint64_t seed = 0;
  std::string program;               ///< name and version of the program
  std::vector<std::string> command;  ///< word by word, as typed
  /// Whether the proxy was cropped by within_reach() after its accuracy was measured. The accuracy is then
  /// that of the whole body.
  bool cropped = false;
};

/// The report of a run as one JSON object, indented, with positions in the input's units and axes.
/// modules/tryon/REPORT.md explains its fields. `drape` may be null.
std::string report_json(const PreparedBody& body, const DrapeReport* drape, const RunInfo& run);

/// The labels of the skin: a line `x y z part` for each welded vertex, in the input's units and axes.
std::string labels_text(const SegmentedSkin& skin);

}  // namespace bodice::tryon
