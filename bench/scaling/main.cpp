// How does each stage scale with workers, what is the serial part, and what does scheduling cost?
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <thread>

#include <CLI/CLI.hpp>

#include "report.hpp"
#include "stage.hpp"

using namespace bodice_bench;

namespace {

/// The command line, with its defaults.
struct Arguments {
  bool quick = false, limits_only = false;
  int workers = static_cast<int>(std::thread::hardware_concurrency());
  std::size_t elements = 0;
  std::string only, folder;
};

void add_options(CLI::App& app, Arguments& a) {
  app.add_flag("--quick", a.quick, "Small sizes, short runs");
  app.add_flag("--limits", a.limits_only, "Only work and span, which a busy machine does not change");
  app.add_option("--workers", a.workers, "Most workers to try")->check(CLI::Range(1, 256));
  app.add_option("--size", a.elements, "Elements of every stage, in place of each one's own number")
      ->check(CLI::Range(1000, 10'000'000));
  app.add_option("--stage", a.only, "Only stages with this text in their names");
  app.add_option("--out", a.folder, "Write scaling.md, scaling.csv and scaling.svg into this folder");
}

/// All measurements of a run.
struct Results {
  std::vector<Limit> limits;
  std::vector<std::vector<Sample>> strong, weak;
};

Results measure_stages(const Arguments& a) {
  const Effort effort{
      .max_workers = a.workers, .seconds_per_sample = a.quick ? 0.05 : 0.4, .patience = a.quick ? 2.0 : 5.0};
  Results results;
  for (const Stage& stage : all_stages()) {
    if (stage.name.find(a.only) == std::string::npos) continue;
    std::fprintf(stderr, "%s ...\n", stage.name.c_str());
    const std::size_t size = a.elements ? a.elements : a.quick ? stage.quick_size : stage.full_size;
    if (!stage.draws_blocks) {
      results.limits.push_back(
          {stage.name, stage.element, size, measure_work_span(stage.make(size), a.workers)});
    }
    if (a.limits_only) continue;
    results.strong.push_back(strong_scaling(stage, size, effort));
    results.weak.push_back(weak_scaling(stage, stage.quick_size, effort));
  }
  return results;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("Strong and weak scaling of every stage, and the cost of scheduling");
  add_options(app, arguments);
  CLI11_PARSE(app, argc, argv);

  const Origin origin = bench::find_origin();
  const std::vector<Cost> costs = arguments.only.empty()
                                      ? scheduling_costs(arguments.workers, arguments.quick ? 20 : 200)
                                      : std::vector<Cost>{};
  const auto [limits, strong, weak] = measure_stages(arguments);
  const std::string markdown = to_markdown(limits, strong, weak, costs, origin);
  std::fputs(markdown.c_str(), stdout);
  if (arguments.folder.empty()) return 0;
  std::vector<std::vector<Sample>> all = strong;
  all.insert(all.end(), weak.begin(), weak.end());
  const std::filesystem::path out = arguments.folder;
  std::filesystem::create_directories(out);
  std::ofstream(out / "scaling.md") << markdown;
  std::ofstream(out / "scaling.csv") << to_csv(all, origin);
  std::ofstream(out / "scaling.svg") << to_svg(strong, origin);
  return 0;
}
