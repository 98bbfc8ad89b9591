#pragma once

#include <concepts>
#include <string>
#include <string_view>
#include <vector>

#include <bench_support/origin.hpp>

namespace bench {

/// A cell of a table: text, a number, or nothing.
class Cell {
 public:
  Cell() = default;
  Cell(std::string text) : text_(std::move(text)) {}
  Cell(std::string_view text) : text_(text) {}
  Cell(const char* text) : text_(text) {}
  Cell(std::integral auto whole) : text_(std::to_string(whole)) {}
  Cell(double number) : is_real_(true), number_(number) {}

  /// The cell as text; numbers have this many significant digits.
  std::string text(int digits) const;

 private:
  std::string text_;
  bool is_real_ = false;
  double number_ = 0.0;
};

/// Rows under named columns. Columns with names ending in _ns, _us, _ms or _s hold times; columns with names
/// ending in _timed hold ratios of times, and pages leave that ending out. Only these columns may differ from
/// run to run.
class Table {
 public:
  /// `name` is that of the CSV file without its ending; `caption` describes the table in one sentence.
  Table(std::string name, std::string caption, std::vector<std::string> columns)
      : name_(std::move(name)), caption_(std::move(caption)), columns_(std::move(columns)) {}

  /// Cells beyond the given ones are empty.
  void add(std::vector<Cell> row);

  const std::string& name() const { return name_; }
  const std::string& caption() const { return caption_; }
  bool empty() const { return rows_.empty(); }

  /// CSV: comment lines with the origin of the numbers, a line of names, and a line for each row.
  std::string csv(const Origin& origin, const std::string& command) const;
  std::string markdown() const;

 private:
  std::string name_, caption_;
  std::vector<std::string> columns_;
  std::vector<std::vector<Cell>> rows_;
};

}  // namespace bench
