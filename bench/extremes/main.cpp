// How large each algorithm's error is, against the input's scale, its distance from the origin and its
// aspect: three tables, a curve a row, on the terminal, and as a page and CSV in a folder. Repeats to the
// bit.
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

#include <CLI/CLI.hpp>

#include <bench_support/table.hpp>

#include "curve.hpp"

namespace {

using extremes_bench::Curve;
using extremes_bench::Placement;

/// A sweep: the quantity that varies, and its values.
struct Range {
  const char *name, *caption;
  std::vector<double> values;
  double Placement::*swept;
  extremes_bench::Sweep sweep;
};

const Range kRanges[] = {
    {"extremes_scale",
     "Error against the input's size in meters.",
     {1e-6, 1e-4, 1e-2, 1.0, 1e2, 1e4, 1e6},
     &Placement::scale_m,
     extremes_bench::kScale},
    {"extremes_offset",
     "Error against the distance from the origin, in sizes of the input (a body 10 km away: 6e3).",
     {0.0, 1.0, 1e2, 1e3, 1e4, 1e5, 1e6},
     &Placement::offset,
     extremes_bench::kOffset},
    {"extremes_aspect",
     "Error against the aspect, longest to shortest extent.",
     {1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6},
     &Placement::aspect,
     extremes_bench::kAspect}};

std::string short_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, value == 0.0 || value >= 0.01 ? "%.2g" : "%.0e", value);
  return std::isinf(value) ? "refused" : text;
}

bench::Table measure(const Range& range, const std::vector<Curve>& curves) {
  std::vector<std::string> columns = {"algorithm", "error"};
  for (const double value : range.values) columns.push_back(short_text(value));
  bench::Table table(range.name, range.caption, columns);
  for (const Curve& curve : curves) {
    if (!(curve.sweeps & range.sweep)) continue;
    std::fprintf(stderr, "extremes: %s: %s\n", range.name, curve.algorithm.c_str());
    std::vector<bench::Cell> row = {curve.algorithm, curve.error};
    for (const double value : range.values) {
      Placement placement;
      placement.*range.swept = value;
      row.emplace_back(short_text(curve.at(placement)));
    }
    table.add(std::move(row));
  }
  return table;
}

std::vector<Curve> all_curves(bool quick) {
  std::vector<Curve> curves;
  for (auto make : {extremes_bench::point_curves, extremes_bench::ellipsoid_curves,
                    extremes_bench::mesh_curves, extremes_bench::body_curves})
    for (Curve& curve : make())
      if (!quick || !curve.algorithm.starts_with("fit")) curves.push_back(std::move(curve));
  return curves;
}

/// Prints the page and, with a folder, writes it there with a CSV file for each table; false if a file cannot
/// be written.
bool report(const std::filesystem::path& folder, bool quick) {
  const std::vector<Curve> curves = all_curves(quick);
  const bench::Origin origin = bench::find_origin();
  if (!folder.empty()) std::filesystem::create_directories(folder);
  const std::string command = quick ? "extremes --quick" : "extremes";
  std::string page = "# Error at the extremes\n\n`" + command + "`, " + bench::title(origin) + "\n";
  bool written = true;
  const auto write = [&](const std::string& file, const std::string& text) {
    if (folder.empty()) return;
    std::ofstream out(folder / file);
    out << text;
    written = written && out.good();
  };
  for (const Range& range : kRanges) {
    const bench::Table table = measure(range, curves);
    page += "\n" + table.caption() + "\n\n" + table.markdown();
    write(table.name() + ".csv", table.csv(origin, command));
  }
  write("extremes.md", page);
  std::fputs(page.c_str(), stdout);
  return written;
}

}  // namespace

int main(int argc, char** argv) {
  std::filesystem::path folder;
  bool quick = false;
  CLI::App app("The error of each algorithm against the input's scale, offset and aspect.", "extremes");
  app.add_option("--out", folder, "folder for the page and CSV files");
  app.add_flag("--quick", quick, "leave out the fits of whole bodies");
  CLI11_PARSE(app, argc, argv);
  return report(folder, quick) ? 0 : 1;
}
