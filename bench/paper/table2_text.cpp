#include <cstdio>

#include "table2.hpp"

namespace paper_bench {
namespace {

template <class... Numbers>
void add(std::string& text, const char* format, Numbers... numbers) {
  char line[512];
  std::snprintf(line, sizeof line, format, numbers...);
  text += line;
}

void add_csv(std::string& text, const Table2Row& row, const char* method, const MethodResult& m) {
  const Approximation& a = m.approximation;
  add(text, "%s,%s,%zu,%s,%zu,%.1f,%.1f,", row.paper.body, row.source.c_str(), row.vertices, method,
      m.ellipsoids, m.segment_ms, m.fit_ms);
  add(text, "%.3f,%.3f,%.3f,%.3f,%.2f,%.2f,%.2f,%.2f\n", a.radial_mean_mm, a.radial_worst_mm, a.gap_mean_mm,
      a.gap_p95_mm, a.interior_percent, a.leak_percent, a.outside_percent, a.outside_mm);
}

void add_approximation(std::string& text, const char* body, const char* method, const MethodResult& m) {
  const Approximation& a = m.approximation;
  add(text, "| %s | %s | %zu | %.1f / %.1f | %.1f / %.1f | %.1f %% | %.1f %% | %.1f %%, %.1f mm |\n", body,
      method, m.ellipsoids, a.radial_mean_mm, a.radial_worst_mm, a.gap_mean_mm, a.gap_p95_mm,
      a.interior_percent, a.leak_percent, a.outside_percent, a.outside_mm);
}

}  // namespace

std::string table2_csv(std::span<const Table2Row> rows) {
  std::string text =
      "body,source,vertices,method,ellipsoids,segment_ms,fit_ms,radial_mean_mm,radial_worst_mm,gap_mean_mm,"
      "gap_p95_mm,interior_percent,leak_percent,outside_percent,outside_mm\n";
  for (const Table2Row& row : rows) {
    add_csv(text, row, "paper tier", row.ours);
    add_csv(text, row, "stand-in for [19]", row.rival);
  }
  return text;
}

std::string table2_markdown(std::span<const Table2Row> rows) {
  std::string text =
      "| body | vertices (paper's) | ellipsoids (paper's) | here, ms: segmentation + fitting | the paper's "
      "method on its machine, s | stand-in for [19] here, ms | [19] in the paper, s | stand-in to ours, here "
      "| [19] to the paper's, there |\n|---|---|---|---|---|---|---|---|---|\n";
  for (const Table2Row& row : rows) {
    const PaperRow& p = row.paper;
    const double ours = row.ours.segment_ms + row.ours.fit_ms;
    add(text, "| %s (%s) | %zu (%d) | %zu (%d) | %.1f + %.1f | %.1f + %.1f ", p.body, row.source.c_str(),
        row.vertices, p.vertices, row.ours.ellipsoids, p.ellipsoids, row.ours.segment_ms, row.ours.fit_ms,
        p.ours_segment_s, p.ours_fit_s);
    add(text, "| 0 + %.0f (%d splits taken back, %d iterations) | %.1f + %.1f | %.1f | %.2f |\n",
        row.rival.fit_ms, row.rival_backtracks, row.rival_iterations, p.theirs_segment_s, p.theirs_fit_s,
        row.rival.fit_ms / ours, (p.theirs_segment_s + p.theirs_fit_s) / (p.ours_segment_s + p.ours_fit_s));
  }
  text +=
      "\nThe approximation (the paper gives no numbers for it). E_j is the paper's measure; the rest is "
      "judged "
      "by the exact signed distance to the skin.\n\n"
      "| body | method | ellipsoids | E_j, mm: mean / worst | gap from union to skin, mm: mean / 95 % | "
      "interior held | deeper than 10 mm, held by none | skin outside, how far |\n"
      "|---|---|---|---|---|---|---|---|\n";
  for (const Table2Row& row : rows) {
    add_approximation(text, row.paper.body, "paper tier", row.ours);
    add_approximation(text, row.paper.body, "stand-in for [19]", row.rival);
  }
  return text;
}

}  // namespace paper_bench
