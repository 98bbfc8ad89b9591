#pragma once

#include <optional>
#include <string>

#include <bodice/tryon/drape.hpp>
#include <bodice/tryon/prepare.hpp>

namespace bodice::tryon {

struct RunInfo {
  int threads = 1;
  std::uint64_t seed = 0;
};

/// The report of README.md as one JSON object, indented. Positions in the input's units and axes.
std::string report_json(const PreparedBody& body, const DrapeReport* drape, const RunInfo& run);

/// One line a welded vertex, `x y z part`, in the input's units and axes.
std::string labels_text(const SegmentedSkin& skin);

}  // namespace bodice::tryon
