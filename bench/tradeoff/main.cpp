// tradeoff [--data DIR] [--out FOLDER] [--quick | --smallest] [--only SWEEP]... [--bodies N] [--threads N]
// FOLDER gets tradeoff.md, a CSV a table and an SVG a plot. Reruns differ only in columns of times.
#include <cstdio>
#include <fstream>

#include <CLI/CLI.hpp>

#include <bench_support/origin.hpp>
#include <bench_support/stopwatch.hpp>

#include "sweep.hpp"

namespace tradeoff {

void progress(const char* what, const std::string& detail) {
  std::fprintf(stderr, "%s: %s ...\n", what, detail.c_str());
}

namespace {

namespace fs = std::filesystem;

constexpr Sweep kSweeps[] = {
    {"front", "Error against time, memory and preparation", sweep_front},
    {"targets", "Targets and budgets: requested and achieved", sweep_targets},
    {"cost-model", "The cost model of time budgets", sweep_cost_model},
    {"regions", "Only what a garment can reach", sweep_regions},
    {"drapes", "A frame of cloth", sweep_drapes},
    {"geodesics", "Distances along the skin", sweep_geodesics},
    {"stops", "Where the fit's iterations stop", sweep_stops},
    {"precision", "Float or double", sweep_precision},
};

std::string chapter(const Sweep& sweep, const Findings& found) {
  std::string text = "\n## " + std::string(sweep.title) + "\n\n" + found.text;
  for (const bench::Table& table : found.shown)
    if (!table.empty()) text += "\n" + table.caption() + "\n\n" + table.markdown();
  for (const auto& [file, plot] : found.plots) text += "\n![" + plot.title + "](" + file + ".svg)\n";
  return text;
}

void write_files(const fs::path& folder, const Findings& found, const bench::Origin& origin,
                 const std::string& command) {
  for (const auto* tables : {&found.shown, &found.details})
    for (const bench::Table& table : *tables)
      if (!table.empty()) std::ofstream(folder / (table.name() + ".csv")) << table.csv(origin, command);
  for (auto [file, plot] : found.plots) {
    plot.footer = title(origin);
    std::ofstream(folder / (file + ".svg")) << to_svg(plot);
  }
}

int run(const Setting& setting, const std::vector<std::string>& only, const fs::path& folder,
        const std::string& command) {
  const bench::Origin origin = bench::find_origin();
  fs::create_directories(folder);
  std::string page = "# Speed against accuracy\n\n`" + command + "`, " + title(origin) + "\n";
  for (const Sweep& sweep : kSweeps) {
    if (!only.empty() && std::ranges::find(only, sweep.name) == only.end()) continue;
    const bench::Stopwatch watch;
    const Findings found = sweep.run(setting);
    page += chapter(sweep, found);
    write_files(folder, found, origin, command);
    std::fprintf(stderr, "%s: done in %.1f s\n", sweep.name, 1e-3 * watch.wall_ms());
  }
  std::ofstream(folder / "tradeoff.md") << page;
  std::fputs(page.c_str(), stdout);
  return 0;
}

}  // namespace
}  // namespace tradeoff

int main(int argc, char** argv) {
  using namespace tradeoff;
  CLI::App app("What each choice costs and what it buys");
  std::string data, folder = "tradeoff";
  std::vector<std::string> only, names;
  bool quick = false, smallest = false;
  int workers = 2, bodies = 1000;
  for (const Sweep& sweep : kSweeps) names.emplace_back(sweep.name);
  app.add_option("--data", data, "folder of bodies to judge beside the made ones")
      ->check(CLI::ExistingDirectory);
  app.add_option("--out", folder, "folder for the page, the tables and the plots");
  app.add_flag("--quick", quick, "small bodies, few settings: under two minutes");
  app.add_flag("--smallest", smallest, "less still: for tests");
  app.add_option("--only", only, "these sweeps only")->check(CLI::IsMember(names));
  app.add_option("--bodies", bodies, "made bodies a sweep, at most")->check(CLI::PositiveNumber);
  app.add_option("--threads", workers, "workers of the fits")->check(CLI::Range(1, 256));
  CLI11_PARSE(app, argc, argv);

  std::string command = "tradeoff";
  for (int i = 1; i < argc; ++i) command += std::string(" ") + argv[i];
  const auto executor = bodice::engine::make_tbb_executor(workers);
  Setting setting;
  setting.context.executor = executor.get();
  setting.effort = smallest ? Effort::kSmallest : quick ? Effort::kQuick : Effort::kFull;
  setting.data = data;
  setting.most_bodies = bodies;
  return run(setting, only, folder, command);
}
