// All logs of a folder as one row a job.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <bodice/engine/json.hpp>
#include <bodice/engine/result.hpp>

namespace bodice::inline v0_1::batch {

/// A line of a manifest and how it ended: the latest that any log has of it.
struct Row {
  std::string manifest;
  std::size_t line = 0;
  bool is_failure = false;
  double error_mm = 0.0;  ///< what sorts rows; 0 where there is none
  /// The log's line as text, since a million of them parsed would fill the memory. A result that was there
  /// has the facts of the run that made it.
  std::string text;
  engine::SortedJson about() const { return engine::SortedJson::parse_or_null(text); }
};

struct Summary {
  std::vector<Row> rows;                     ///< failures first, then by error, the largest first
  std::vector<std::string> inputs, numbers;  ///< names that any row has
  std::size_t lost = 0;  ///< results of the logs with folders that are gone; they count as failures
};

/// Fails with kNotFound where no batch has run, and with kUnreadable.
engine::Result<Summary> read_summary(const std::filesystem::path& out);

}  // namespace bodice::batch
