// How does each stage scale with workers, what is the serial part, and what does scheduling cost?
//
//     build/release/bench/scaling [--quick] [--workers N] [--size N] [--stage TEXT] [--out FOLDER]
//
// FOLDER gets scaling.md, scaling.csv and scaling.svg.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <thread>

#include <CLI/CLI.hpp>

#include "report.hpp"
#include "stage.hpp"

using namespace bodice_bench;

int main(int argc, char** argv) {
  CLI::App app("Strong and weak scaling of every stage, and the cost of scheduling");
  bool quick = false, limits_only = false;
  int workers = static_cast<int>(std::thread::hardware_concurrency());
  std::size_t elements = 0;
  std::string only, folder;
  app.add_flag("--quick", quick, "Small sizes, short runs");
  app.add_flag("--limits", limits_only, "Only what the blocks allow, which a busy machine does not disturb");
  app.add_option("--workers", workers, "Most workers to try")->check(CLI::Range(1, 256));
  app.add_option("--size", elements, "Elements of every stage, in place of each one's own number")
      ->check(CLI::Range(1000, 10'000'000));
  app.add_option("--stage", only, "Only stages whose name holds this text");
  app.add_option("--out", folder, "Write scaling.md, scaling.csv and scaling.svg into this folder");
  CLI11_PARSE(app, argc, argv);

  const Effort effort{
      .max_workers = workers, .seconds_per_sample = quick ? 0.05 : 0.4, .patience = quick ? 2.0 : 5.0};
  const Origin origin = bench::find_origin();
  const std::vector<Cost> costs =
      only.empty() ? scheduling_costs(workers, quick ? 20 : 200) : std::vector<Cost>{};
  std::vector<Limit> limits;
  std::vector<std::vector<Sample>> strong, weak, all;
  for (const Stage& stage : all_stages()) {
    if (stage.name.find(only) == std::string::npos) continue;
    std::fprintf(stderr, "%s ...\n", stage.name.c_str());
    const std::size_t size = elements ? elements : quick ? stage.quick_size : stage.full_size;
    if (!stage.draws_blocks) {
      limits.push_back({stage.name, stage.element, size, measure_work_span(stage.make(size), workers)});
    }
    if (limits_only) continue;
    strong.push_back(strong_scaling(stage, size, effort));
    weak.push_back(weak_scaling(stage, stage.quick_size, effort));
  }
  const std::string markdown = to_markdown(limits, strong, weak, costs, origin);
  std::fputs(markdown.c_str(), stdout);
  if (folder.empty()) return 0;
  all = strong;
  all.insert(all.end(), weak.begin(), weak.end());
  const std::filesystem::path out = folder;
  std::filesystem::create_directories(out);
  std::ofstream(out / "scaling.md") << markdown;
  std::ofstream(out / "scaling.csv") << to_csv(all, origin);
  std::ofstream(out / "scaling.svg") << to_svg(strong, origin);
  return 0;
}
