// The folder of results: a page of text with its tables, and beside it their CSV files and plots.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include <bench_support/plot.hpp>
#include <bench_support/table.hpp>
#include <bodice/engine/result.hpp>

namespace paper_bench {

/// The page and its files, written as they are added.
class Page {
 public:
  /// `command` is the command line that made the folder.
  Page(std::filesystem::path folder, std::string command);

  const std::filesystem::path& folder() const { return folder_; }
  void add(const std::string& markdown) { text_ += markdown + "\n\n"; }
  /// Adds the table to the page, and writes NAME.csv.
  void add(const bench::Table& table);
  /// Writes NAME.svg, and shows it in the page.
  void add(const std::string& name, bench::Plot plot);

  /// Writes paper.md; the first file that could not be written is the error.
  bodice::engine::Result<void> finish();

 private:
  void write(const std::string& name, const std::string& content);

  std::filesystem::path folder_;
  std::string command_;
  bench::Origin origin_;
  std::string text_;
  std::optional<bodice::engine::Error> failed_;
};

}  // namespace paper_bench
