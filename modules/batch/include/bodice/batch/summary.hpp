// The results of all batches on a folder, as tables and as a page.
#pragma once

#include <cstddef>
#include <filesystem>

#include <bodice/engine/result.hpp>

namespace bodice::inline v0_1::batch {

/// What a summary counts. A line of a manifest counts once, by its latest run.
struct SummaryCounts {
  std::size_t jobs = 0, done = 0, failed = 0;
  std::size_t lost = 0;  ///< those of `failed` with a result in the log, and no folder
};

/// The jobs that the page shows with a picture. Tables have all.
inline constexpr std::size_t kShownOnPage = 500;

/// Writes summary.csv, summary.json, failures.jsonl and summary.html into the folder: failures first, then by
/// `error_mm`, the largest first. Fails with kNotFound where no batch has run, with kUnreadable and
/// kWriteFailed. Cost: one line of a log and one look at a folder for each job.
engine::Result<SummaryCounts> write_summary(const std::filesystem::path& out);

}  // namespace bodice::batch
