#include "bench_support/table.hpp"

#include <cmath>
#include <cstdio>

namespace bench {
namespace {

constexpr int kDigitsInCsv = 6, kDigitsInText = 3;

std::string quoted(const std::string& text) {
  return text.find(',') == std::string::npos ? text : '"' + text + '"';
}

std::string words(std::string name) {
  constexpr std::string_view kTimed = "_timed";
  if (name.ends_with(kTimed)) name.resize(name.size() - kTimed.size());
  for (char& c : name)
    if (c == '_') c = ' ';
  return name;
}

/// Whole numbers stay whole, however long: no exponents in a table that people read.
std::string for_people(double number) {
  char text[64];
  const bool is_long = std::abs(number) >= 100.0 && std::abs(number) < 1e9;
  if (is_long)
    std::snprintf(text, sizeof text, "%.0f", number);
  else
    std::snprintf(text, sizeof text, "%.*g", kDigitsInText, number);
  return text;
}

}  // namespace

std::string Cell::text(int digits) const {
  if (!is_real_) return text_;
  if (digits == kDigitsInText) return for_people(number_);
  char text[64];
  std::snprintf(text, sizeof text, "%.*g", digits, number_);
  return text;
}

void Table::add(std::vector<Cell> row) {
  row.resize(columns_.size());
  rows_.push_back(std::move(row));
}

std::string Table::csv(const Origin& origin, const std::string& command) const {
  std::string text = "# command: " + command + "\n# commit: " + origin.commit +
                     "\n# compiler: " + origin.compiler + ", " + origin.flags + "\n# cpu: " + origin.cpu +
                     ", " + std::to_string(origin.hardware_threads) + " hardware threads\n";
  for (std::size_t c = 0; c < columns_.size(); ++c) text += (c ? "," : "") + quoted(columns_[c]);
  text += '\n';
  for (const auto& row : rows_) {
    for (std::size_t c = 0; c < row.size(); ++c) text += (c ? "," : "") + quoted(row[c].text(kDigitsInCsv));
    text += '\n';
  }
  return text;
}

std::string Table::markdown() const {
  std::string text = "|", rule = "|";
  for (const std::string& column : columns_) text += ' ' + words(column) + " |", rule += "---|";
  text += '\n' + rule + '\n';
  for (const auto& row : rows_) {
    text += '|';
    for (const Cell& cell : row) text += ' ' + cell.text(kDigitsInText) + " |";
    text += '\n';
  }
  return text;
}

}  // namespace bench
