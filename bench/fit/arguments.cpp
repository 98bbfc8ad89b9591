#include "arguments.hpp"

#include <cstdlib>
#include <map>

#include <CLI/CLI.hpp>

namespace fit_bench {
namespace {

using bodice::proxy::Tier;

const std::map<std::string, Tier> kTiers = {
    {"paper", Tier::kPaper}, {"solid", Tier::kSolid}, {"tight", Tier::kTight}, {"relief", Tier::kRelief}};

void add_subjects(CLI::App& app, Arguments& a) {
  app.add_option("data", a.data, "folder of bodies NAME.obj with labels");
  app.add_option("--body", a.bodies, "a body of that folder")->allow_extra_args(false);
  app.add_option("--synth", a.seeds, "a made body, by its seed (1 without any body)")
      ->allow_extra_args(false);
  app.add_option("--tier", a.tiers, "a tier (all)")
      ->allow_extra_args(false)
      ->transform(CLI::CheckedTransformer(kTiers))
      ->option_text("{paper,solid,tight,relief} ...");
  app.add_option("--count", a.counts, "a number of ellipsoids (8 to 400)")->allow_extra_args(false);
  app.add_option("--threads", a.threads, "workers of the fits")->check(CLI::Range(1, 256));
  app.add_option("--seconds", a.seconds, "time budget of each fit");
}

void add_questions(CLI::App& app, Arguments& a) {
  app.add_option("--svg", a.svg, "file for a plot of error against ellipsoids");
  app.add_option("--target", a.targets_mm, "a target error, mm: is it reached?")->allow_extra_args(false);
  app.add_option("--budget", a.budgets_us, "a budget, microseconds: is it kept?")->allow_extra_args(false);
  app.add_flag("--bars", a.bars, "every tier with 89 ellipsoids beside its bars; fails if one is missed");
  app.add_flag("--gap-formula", a.gap_formula,
               "constants of the target search, from the fits of --tier and --count");
  app.add_flag("--anytime", a.anytime, "error against time of the proxies that anytime tiers publish");
  app.add_flag("--growth", a.growth, "time against the number of vertices");
}

}  // namespace

Arguments read_arguments(int argc, char** argv) {
  Arguments a;
  CLI::App app(
      "Accuracy and time of fits. Prints CSV: a line for each body, tier and count, unless a question is "
      "chosen.");
  add_subjects(app, a);
  add_questions(app, a);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::exit(app.exit(error));
  }
  if (a.tiers.empty()) a.tiers = {Tier::kPaper, Tier::kSolid, Tier::kTight, Tier::kRelief};
  if (a.bodies.empty() && a.seeds.empty()) a.seeds = {1};
  return a;
}

}  // namespace fit_bench
