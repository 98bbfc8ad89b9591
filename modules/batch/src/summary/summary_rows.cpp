#include "summary/summary_rows.hpp"

#include <algorithm>
#include <fstream>
#include <map>
#include <set>
#include <tuple>

#include <unistd.h>

#include "process/outcome.hpp"

namespace bodice::inline v0_1::batch {
namespace {

namespace fs = std::filesystem;
using engine::SortedJson;

/// A log with a header that could be read.
struct RunLog {
  fs::path file;
  std::string manifest;
  std::int64_t started_ns = 0;
  std::size_t lines = 0;
};

/// The next line as JSON; a line that a killed run did not end is passed over.
bool next(std::ifstream& stream, SortedJson& line) {
  for (std::string text; std::getline(stream, text);) {
    line = SortedJson::parse_or_null(text);
    if (line.is_object()) return true;
  }
  return false;
}

std::vector<RunLog> logs_by_time(const fs::path& folder) {
  std::vector<RunLog> logs;
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
    std::ifstream stream(entry.path());
    SortedJson line;
    if (entry.path().extension() != ".jsonl" || !next(stream, line) || !line.contains("run")) continue;
    const SortedJson& run = line["run"];
    logs.push_back({entry.path(), run.value("manifest", ""), run.value("started_ns", std::int64_t{0}),
                    run.value("lines", std::size_t{0})});
  }
  std::ranges::sort(logs, {}, [](const RunLog& log) { return std::pair(log.started_ns, log.file); });
  return logs;
}

/// The facts of a result, as its folder has them: for results without a log.
SortedJson facts_in(const fs::path& folder) {
  std::ifstream stream(folder / "job.json");
  return SortedJson::parse_or_null(std::string(std::istreambuf_iterator<char>(stream), {}));
}

/// Reads rows of logs from the oldest on, so that later ones replace them.
class Reader {
 public:
  explicit Reader(fs::path out) : out_(std::move(out)) {}

  void add(const RunLog& log) {
    std::ifstream stream(log.file);
    SortedJson line;
    auto& rows = rows_[log.manifest];
    rows.erase(rows.upper_bound(log.lines), rows.end());  // the manifest had more lines in an earlier run
    while (next(stream, line)) {
      if (!line.contains("line")) continue;
      const auto number = line.value("line", std::size_t{0});
      if (line.value("outcome", "") == "done") made_[line.value("folder", "")] = {log.manifest, number};
      std::string& row = rows[number];
      if (line.value("outcome", "") == "there") add_facts(line, row);
      row = one_line(line);
    }
  }

  Summary finish() {
    Summary summary;
    std::set<std::string> inputs, numbers;
    for (auto& [manifest, rows] : rows_)
      for (auto& [number, text] : rows) {
        SortedJson about = SortedJson::parse_or_null(text);
        about["manifest"] = manifest;
        if (about.value("outcome", "") != "failed" && !is_there(about)) {
          about["outcome"] = "failed", about["failure"] = "lost";
          about["reason"] = "Its result is no longer there. Start the batch again.";
          ++summary.lost;
        }
        const SortedJson values = about.value("numbers", SortedJson::object()),
                         job = about.value("job", SortedJson::object());
        for (const auto& [name, value] : job.items()) inputs.insert(name);
        for (const auto& [name, value] : values.items()) numbers.insert(name);
        summary.rows.push_back({manifest, number, about.value("outcome", "") == "failed",
                                values.value("error_mm", 0.0), one_line(about)});
        std::string().swap(text);
      }
    summary.inputs.assign(inputs.begin(), inputs.end());
    summary.numbers.assign(numbers.begin(), numbers.end());
    return summary;
  }

 private:
  bool is_there(const SortedJson& about) const {
    return ::access((out_ / about.value("folder", "")).c_str(), F_OK) == 0;
  }

  /// Adds what the run that made the result wrote of it. `before` is the row so far.
  void add_facts(SortedJson& line, const std::string& before) {
    const std::string folder = line.value("folder", "");
    const auto of_folder = [&folder](const std::string& text) {
      SortedJson row = text.empty() ? SortedJson() : SortedJson::parse_or_null(text);
      const bool fits = row.is_object() && row.value("folder", "") == folder && row.contains("seconds");
      return fits ? row : SortedJson();
    };
    SortedJson facts = of_folder(before);
    if (const auto made = made_.find(folder); !facts.is_object() && made != made_.end())
      facts = of_folder(rows_[made->second.first][made->second.second]);
    if (!facts.is_object()) facts = facts_in(out_ / folder);
    for (const char* name : {"seconds", "cpu_seconds", "shared_seconds", "shared_cpu_seconds", "memory_mb",
                             "attempts", "seed", "warnings", "numbers"})
      if (facts.is_object() && facts.contains(name)) line[name] = facts[name];
  }

  fs::path out_;
  std::map<std::string, std::map<std::size_t, std::string>> rows_;   // by manifest and line
  std::map<std::string, std::pair<std::string, std::size_t>> made_;  // folder to the line that made it
};

}  // namespace

engine::Result<Summary> read_summary(const fs::path& out) {
  const std::vector<RunLog> logs = logs_by_time(out / "log");
  if (logs.empty())
    return engine::Error{engine::ErrorCode::kNotFound, "No batch has run into '" + out.string() + "'.",
                         "Name the folder of --out."};
  Reader reader(out);
  for (const RunLog& log : logs) reader.add(log);
  Summary summary = reader.finish();
  std::ranges::stable_sort(summary.rows, [](const Row& a, const Row& b) {
    return std::tuple(!a.is_failure, -a.error_mm) < std::tuple(!b.is_failure, -b.error_mm);
  });
  return summary;
}

}  // namespace bodice::batch
