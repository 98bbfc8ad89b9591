// How long does a catalogue take on n nodes, with slow and lost ones, and in how many shards should it go?
// Simulated job by job with recorded times.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <numeric>
#include <string>
#include <vector>

#include <bench_support/help.hpp>
#include <bench_support/origin.hpp>
#include <bench_support/plot.hpp>

#include "simulate.hpp"

namespace {

using cluster::Model;

/// Shards a node in the plot and in the last columns of the table.
constexpr std::size_t kShardsANode = 16;

struct Arguments {
  std::string times = BODICE_JOB_SECONDS, plot;
  std::size_t jobs = 1'000'000;
  int cores = 16;
  double mean_s = 0.0;  ///< times are scaled to this mean; 0: as they are
};

Arguments read(int argc, char** argv) {
  Arguments arguments;
  int position = 0;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--plot" && i + 1 < argc)
      arguments.plot = argv[++i];
    else if (word == "--mean" && i + 1 < argc)
      arguments.mean_s = std::atof(argv[++i]);
    else if (position == 0)
      arguments.times = word, ++position;
    else if (position == 1)
      arguments.jobs = std::strtoull(argv[i], nullptr, 10), ++position;
    else
      arguments.cores = std::atoi(argv[i]);
  }
  return arguments;
}

std::vector<double> seconds_in(const std::string& file) {
  std::vector<double> seconds;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);)
    if (const double value = std::atof(line.c_str()); value > 0.0) seconds.push_back(value);
  return seconds;
}

std::string clock(double seconds) {
  char text[32];
  if (seconds < 600.0)
    std::snprintf(text, sizeof text, "%.0f s", seconds);
  else if (seconds < 36000.0)
    std::snprintf(text, sizeof text, "%.0f min", seconds / 60.0);
  else
    std::snprintf(text, sizeof text, "%.1f h", seconds / 3600.0);
  return text;
}

/// The same nodes under four fates.
std::vector<Model> fates(std::size_t nodes, int cores, std::size_t jobs) {
  Model calm;
  calm.nodes = nodes, calm.cores = cores;
  calm.shards = std::min(nodes, jobs);
  Model many = calm;
  many.shards = std::min(nodes * kShardsANode, jobs);
  Model slow_one = calm, slow_many = many, hung = many, lost = many;
  slow_one.slow_share = slow_many.slow_share = 0.02;
  hung.hung_share = 1e-4;
  lost.hours_to_loss = 10.0;
  return {calm, many, slow_one, slow_many, hung, lost};
}

constexpr const char* kUsage =
    "cluster [TIMES [JOBS [CORES]]] [--mean SECONDS] [--plot FILE.svg]\n"
    "How long a catalogue takes on n nodes, with slow and lost ones, in how many shards, simulated job by "
    "job.\n"
    "TIMES has the seconds of a job a line; default: those beside the source.\n";

}  // namespace

int main(int argc, char** argv) {
  if (bench::help_requested(argc, argv, kUsage)) return 0;
  const Arguments arguments = read(argc, argv);
  std::vector<double> seconds = seconds_in(arguments.times);
  if (seconds.empty() || arguments.jobs == 0 || arguments.cores < 1)
    return std::printf("%s: no times, or no jobs or cores.\n", arguments.times.c_str()), 1;
  double mean_s = std::accumulate(seconds.begin(), seconds.end(), 0.0) / static_cast<double>(seconds.size());
  if (arguments.mean_s > 0.0) {
    for (double& each : seconds) each *= arguments.mean_s / mean_s;
    mean_s = arguments.mean_s;
  }
  std::printf("%zu jobs on nodes of %d cores; %zu recorded times, %.2f s in the mean, %.2f s the longest\n",
              arguments.jobs, arguments.cores, seconds.size(), mean_s, *std::ranges::max_element(seconds));
  std::printf(
      "slow: 2 %% of the nodes take 3 times as long; hung: one job of 10,000 takes 600 s; lost: each node "
      "once in\n"
      "10 h of work, back after 30 min. Columns: shards a node.\n\n"
      "| nodes | least | 1 | %zu | slow, 1 | slow, %zu | hung, %zu | lost, %zu | lost nodes | wasted |\n"
      "|---|---|---|---|---|---|---|---|---|---|\n",
      kShardsANode, kShardsANode, kShardsANode, kShardsANode);
  const char* const names[] = {"1 shard a node",        "16 shards a node", "slow nodes, 1 shard",
                               "slow nodes, 16 shards", "hung jobs, 16",    "lost nodes, 16"};
  bench::Plot plot{.title = "A catalogue on n nodes",
                   .x_label = "nodes",
                   .y_label = "hours to the last result",
                   .footer = bench::title(bench::find_origin()),
                   .series = {}};
  for (const char* const name : names) plot.series.push_back({.name = name, .points = {}, .line = true});
  for (const std::size_t nodes : {1, 10, 30, 100, 300, 1000, 3000, 10000}) {
    const std::vector<Model> models = fates(nodes, arguments.cores, arguments.jobs);
    std::printf("| %zu | %s |", nodes, clock(least_makespan_s(models[0], seconds, arguments.jobs)).c_str());
    cluster::Outcome outcome;
    for (std::size_t i = 0; i < models.size(); ++i) {
      outcome = simulate(models[i], seconds, arguments.jobs);
      std::printf(" %s |", clock(outcome.makespan_s).c_str());
      plot.series[i].points.push_back({static_cast<double>(nodes), outcome.makespan_s / 3600.0, ""});
    }
    std::printf(" %zu | %.2f %% |\n", outcome.losses,
                100.0 * outcome.wasted_s / (outcome.busy_s + outcome.wasted_s));
    std::fflush(stdout);
  }
  if (!arguments.plot.empty()) std::ofstream(arguments.plot) << to_svg(plot);
  return 0;
}
