#pragma once

#include <filesystem>
#include <string>

#include <bodice/batch/summary.hpp>

#include "summary/summary_rows.hpp"

namespace bodice::inline v0_1::batch {

/// The file in a result's folder that the page shows, if it is there.
inline constexpr const char* kThumbnail = "thumbnail.png";

/// One HTML file without a script: failures, then the first results with their pictures, which are part of
/// the file. `out` is where the results are.
std::string summary_page(const std::filesystem::path& out, const Summary& summary,
                         const SummaryCounts& counts);

}  // namespace bodice::batch
