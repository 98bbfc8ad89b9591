// The paper's figure 8: one ellipsoid a part, one threshold for the whole body, one for the torso and one for
// the limbs.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <bench_support/table.hpp>
#include <bodice/engine/result.hpp>

#include "bodies.hpp"

namespace paper_bench {

/// A picture of one fit.
struct Figure8Picture {
  std::string file, caption;
};

/// All fits of one body.
struct Figure8Row {
  std::vector<std::vector<bench::Cell>> cells;  ///< a row of the table for each fit
  std::vector<Figure8Picture> pictures;
};

/// Fits one body three times with the paper's tier, and writes a picture of each fit to `folder`.
bodice::engine::Result<Figure8Row> draw_figure8(const Subject& subject, std::size_t samples,
                                                const std::filesystem::path& folder);

bench::Table figure8_table(const std::vector<Figure8Row>& rows);
/// A table in Markdown with the pictures of each body side by side.
std::string figure8_pictures(const std::vector<Figure8Row>& rows);

}  // namespace paper_bench
