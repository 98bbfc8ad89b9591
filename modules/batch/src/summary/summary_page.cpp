#include "summary/summary_page.hpp"

#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <span>

#include <bodice/engine/base64.hpp>

namespace bodice::inline v0_1::batch {
namespace {

namespace fs = std::filesystem;
using engine::SortedJson;

constexpr std::size_t kFailuresShown = 1000;

constexpr const char* kHead = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<title>bodice batch</title><style>
:root { color-scheme: light dark; --ink: #223; --paper: #fff; --line: #dde; --soft: #667; --bad: #a22; }
@media (prefers-color-scheme: dark) { :root { --ink: #e6eaf0; --paper: #171c22; --line: #36404c; --soft: #9aa4b2; --bad: #ff8a80; } }
body { font: 15px/1.5 system-ui, sans-serif; margin: 2em auto; max-width: 75em; padding: 0 1em; color: var(--ink); background: var(--paper); }
table { border-collapse: collapse; width: 100%; } td, th { text-align: left; padding: .2em .8em .2em 0; vertical-align: top; }
tr { border-top: 1px solid var(--line); } .why { color: var(--bad); overflow-wrap: anywhere; }
.results { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(13em, 42vw), 1fr)); gap: 1em; }
.results a { display: block; border: 1px solid var(--line); border-radius: 6px; padding: .6em; color: inherit; text-decoration: none; }
.results a:hover { border-color: var(--soft); }
/* Pictures of fits have two views side by side: the left one fills the frame, as that of a drape does. */
.results img { display: block; width: 100%; aspect-ratio: 2 / 3; object-fit: cover; object-position: left; } .results b { font-size: 1.1em; }
small { color: var(--soft); display: block; overflow-wrap: anywhere; }
</style></head><body>
)";

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  return out;
}

std::string picture(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  if (bytes.empty()) return "";
  return "<img alt=\"\" src=\"data:image/png;base64," + engine::base64(std::as_bytes(std::span(bytes))) +
         "\">";
}

/// The job as its line has it: "body a.obj, garment b.obj".
std::string words_of(const SortedJson& about) {
  std::string text;
  const SortedJson job = about.value("job", SortedJson::object());
  for (const auto& [name, values] : job.items()) {
    text += (text.empty() ? "" : ", ") + name;
    for (const SortedJson& value : values) text += " " + value.get<std::string>();
  }
  return text;
}

void add_failures(const Summary& summary, std::size_t failed, std::string& page) {
  page += "<h2>Failed: " + std::to_string(failed) + "</h2>\n";
  if (failed == 0) return;
  page += "<table><tr><th>line<th>kind<th>why<th>job</tr>\n";
  std::size_t shown = 0;
  for (const Row& row : summary.rows) {
    if (!row.is_failure || shown == kFailuresShown) break;
    ++shown;
    const SortedJson about = row.about();
    page += "<tr><td>" + std::to_string(row.line) + "<td>" + escaped(about.value("failure", "")) +
            "<td class=why>" + escaped(about.value("reason", "")) + "<td><small>" + escaped(words_of(about)) +
            "</small></tr>\n";
  }
  page += "</table>\n";
  if (shown < failed) page += "<p>failures.jsonl has all of them.</p>\n";
}

/// Two digits behind the point, in any locale.
std::string millimeters(double mm) {
  const auto hundredths = static_cast<long long>(std::llround(100.0 * mm));
  const std::string rest = std::to_string(hundredths % 100);
  return std::to_string(hundredths / 100) + (rest.size() < 2 ? ".0" : ".") + rest;
}

void add_result(const fs::path& out, const Row& row, std::string& page) {
  const SortedJson about = row.about();
  const std::string folder = about.value("folder", "");
  page += "<a href=\"" + escaped(folder) + "/\">" + picture(out / folder / kThumbnail) + "<b>" +
          millimeters(row.error_mm) + " mm</b> line " + std::to_string(row.line);
  if (const std::size_t warnings = about.value("warnings", SortedJson::array()).size())
    page += ", " + std::to_string(warnings) + (warnings == 1 ? " warning" : " warnings");
  page += "<small>" + escaped(words_of(about)) + "</small></a>\n";
}

}  // namespace

std::string summary_page(const fs::path& out, const Summary& summary, const SummaryCounts& counts) {
  std::string page = kHead;
  page += "<h1>" + std::to_string(counts.jobs) + " jobs, " + std::to_string(counts.done) + " results, " +
          std::to_string(counts.failed) + " failed</h1>\n";
  add_failures(summary, counts.failed, page);
  page +=
      "<h2>Results, the largest error first</h2>\n<p>The error is the deepest point of cloth inside the skin "
      "in "
      "any frame; of a fit alone, the largest distance from the proxy to the skin. "
      "<code>bodice report FOLDER -o page.html</code> makes a page of a result.";
  if (counts.done > kShownOnPage)
    page += " The first " + std::to_string(kShownOnPage) + " are here; summary.csv has all.";
  page += "</p>\n<div class=results>\n";
  std::size_t shown = 0;
  for (const Row& row : summary.rows) {
    if (row.is_failure) continue;
    if (++shown > kShownOnPage) break;
    add_result(out, row, page);
  }
  return page + "</div></body></html>\n";
}

}  // namespace bodice::batch
