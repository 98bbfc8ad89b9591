#include <bodice/batch/summary.hpp>

#include <algorithm>
#include <fstream>
#include <map>
#include <utility>
#include <vector>

#include <bodice/engine/json.hpp>
#include <bodice/engine/write_file.hpp>

#include "summary/summary_page.hpp"
#include "summary/summary_rows.hpp"

namespace bodice::inline v0_1::batch {
namespace {

namespace fs = std::filesystem;
using engine::SortedJson;

/// A field as CSV has it (RFC 4180).
std::string field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

std::string csv_of(const Summary& summary) {
  std::string text =
      "manifest,line,outcome,failure,reason,folder,seconds,cpu_seconds,shared_seconds,shared_cpu_seconds,"
      "memory_mb,attempts,seed,warnings";
  for (const std::string& name : summary.inputs) text += "," + field(name);
  for (const std::string& name : summary.numbers) text += "," + field(name);
  text += "\n";
  // A number or text without quotes.
  const auto plain = [](const SortedJson& value) {
    return value.is_null() ? std::string() : value.is_string() ? value.get<std::string>() : value.dump();
  };
  for (const Row& row : summary.rows) {
    const SortedJson about = row.about();
    text += field(row.manifest) + "," + std::to_string(row.line);
    for (const char* name : {"outcome", "failure", "reason", "folder", "seconds", "cpu_seconds",
                             "shared_seconds", "shared_cpu_seconds", "memory_mb", "attempts", "seed"})
      text += "," + field(plain(about.value(name, SortedJson())));
    text += "," + std::to_string(about.value("warnings", SortedJson::array()).size());
    for (const std::string& name : summary.inputs) {
      std::string values;
      for (const SortedJson& value :
           about.value("job", SortedJson::object()).value(name, SortedJson::array()))
        values += (values.empty() ? "" : ";") + plain(value);
      text += "," + field(values);
    }
    for (const std::string& name : summary.numbers)
      text += "," + field(plain(about.value("numbers", SortedJson::object()).value(name, SortedJson())));
    text += "\n";
  }
  return text;
}

/// One object with an array of rows, a row a line.
std::string json_text_of(const Summary& summary, const SummaryCounts& counts) {
  std::string text = "{\"jobs\": " + std::to_string(counts.jobs) +
                     ", \"done\": " + std::to_string(counts.done) +
                     ", \"failed\": " + std::to_string(counts.failed) + ", \"rows\": [";
  for (std::size_t i = 0; i < summary.rows.size(); ++i) text += (i ? ",\n" : "\n") + summary.rows[i].text;
  return text + "\n]}\n";
}

std::string failures_of(const Summary& summary) {
  std::string text;
  for (const Row& row : summary.rows)
    if (row.is_failure) text += row.text + "\n";
  return text;
}

}  // namespace

engine::Result<SummaryCounts> write_summary(const fs::path& out) {
  auto read = read_summary(out);
  if (!read) return std::move(read).error();
  const Summary& summary = *read;
  SummaryCounts counts{.jobs = summary.rows.size(), .lost = summary.lost};
  for (const Row& row : summary.rows) ++(row.is_failure ? counts.failed : counts.done);
  const std::pair<const char*, std::string> files[] = {{"summary.csv", csv_of(summary)},
                                                       {"summary.json", json_text_of(summary, counts)},
                                                       {"failures.jsonl", failures_of(summary)},
                                                       {"summary.html", summary_page(out, summary, counts)}};
  for (const auto& [name, text] : files)
    if (auto written = engine::write_file(out / name, std::string_view(text)); !written)
      return std::move(written).error();
  return counts;
}

}  // namespace bodice::batch
