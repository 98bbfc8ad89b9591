// The folder of results: a page of text with its tables, and beside it their CSV files and plots.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include <bench_support/plot.hpp>
#include <bench_support/table.hpp>
#include <bodice/engine/result.hpp>

namespace paper_bench {

class Page {
 public:
  /// `command` is how the folder was made.
  Page(std::filesystem::path folder, std::string command);

  const std::filesystem::path& folder() const { return folder_; }
  void add(const std::string& markdown) { text_ += markdown + "\n\n"; }
  /// The table into the page, and NAME.csv.
  void add(const bench::Table& table);
  /// NAME.svg, shown in the page.
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
