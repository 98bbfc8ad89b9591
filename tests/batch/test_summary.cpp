// Summaries: a row a line of a manifest, by its latest run.
#include <doctest/doctest.h>

#include <sstream>

#include <bodice/batch/summary.hpp>

#include "fake_work.hpp"

using namespace bodice;
using bodice_test::BatchFolder;

namespace {

std::vector<nlohmann::json> rows_of(const BatchFolder& folder) {
  const auto rows = nlohmann::json::parse(folder.read(folder / "out/summary.json"))["rows"];
  return {rows.begin(), rows.end()};
}

}  // namespace

TEST_CASE("a summary has failures first, then the largest error, in tables and on the page") {
  BatchFolder folder(
      {R"({"n": 2})", R"({"n": 5})", R"({"n": 3, "do": "fail"})", R"({"n": 4, "body": "a,<b>.obj"})"});
  folder.write("a,<b>.obj", "a body");
  REQUIRE(folder.run().ok());
  const auto counts = batch::write_summary(folder / "out");
  REQUIRE(counts.ok());
  CHECK(counts->jobs == 4);
  CHECK(counts->done == 3);
  CHECK(counts->failed == 1);
  std::vector<int> lines;
  for (const auto& row : rows_of(folder)) lines.push_back(row["line"]);
  CHECK(lines == std::vector<int>{3, 2, 4, 1});
  const std::string csv = folder.read(folder / "out/summary.csv"),
                    page = folder.read(folder / "out/summary.html");
  std::istringstream table(csv);
  std::string header, first;
  std::getline(table, header), std::getline(table, first);
  CHECK(header.find(",body,") != std::string::npos);
  CHECK(header.find(",error_mm") != std::string::npos);
  CHECK(first.find("The body is corrupt") != std::string::npos);
  CHECK(csv.find("a,<b>.obj\"") != std::string::npos);
  CHECK(std::ranges::count(csv, '\n') == 5);
  CHECK(page.find("The body is corrupt") != std::string::npos);
  CHECK(page.find("a,&lt;b&gt;.obj") != std::string::npos);
  CHECK(page.find("<b>.obj") == std::string::npos);
  CHECK(page.find(">5.00 mm") < page.find(">4.00 mm"));
  CHECK(folder.read(folder / "out/failures.jsonl").find("\"line\":3") != std::string::npos);
}

TEST_CASE("a line counts by its latest run, in one shard or several, and keeps the facts of what was there") {
  BatchFolder folder({R"({"n": 1})", "broken", R"({"n": 3, "do": "fail"})", R"({"n": 4})"});
  REQUIRE(folder.run().ok());
  folder.write("jobs.jsonl",
               "{\"n\": 1}\n{\"n\": 2}\n{\"n\": 3, \"do\": \"fail\"}\n");  // mended, and a line less
  for (std::size_t shard = 0; shard < 3; ++shard) REQUIRE(folder.run({.shard = shard, .shards = 3}).ok());
  auto counts = batch::write_summary(folder / "out");
  REQUIRE(counts.ok());
  CHECK(counts->jobs == 3);
  CHECK(counts->failed == 1);
  for (const auto& row : rows_of(folder)) {
    if (row["line"] == 3) continue;
    CHECK(row.contains("memory_mb"));
    CHECK(row["numbers"]["error_mm"] == row["line"]);
  }
  // Without logs of the first run the facts come from the results.
  for (const auto& log : std::filesystem::directory_iterator(folder / "out/log"))
    std::filesystem::remove(log);
  REQUIRE(folder.run().ok());
  REQUIRE(batch::write_summary(folder / "out").ok());
  for (const auto& row : rows_of(folder))
    if (row["line"] != 3) CHECK(row["numbers"]["error_mm"] == row["line"]);
}

TEST_CASE("a result that was removed is named as lost, and nothing to summarize is an error") {
  BatchFolder folder({R"({"n": 1})"});
  CHECK_FALSE(batch::write_summary(folder / "out").ok());
  REQUIRE(folder.run().ok());
  for (const auto& [key, value] : folder.results())
    std::filesystem::remove_all(folder / ("out/" + key.substr(0, 2)));
  const auto counts = batch::write_summary(folder / "out");
  REQUIRE(counts.ok());
  CHECK(counts->lost == 1);
  CHECK(counts->failed == 1);
}
