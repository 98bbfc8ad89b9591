#include <atomic>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <memory>

#include <unistd.h>

#include <bodice/batch/batch.hpp>
#include <bodice/batch/summary.hpp>
#include <bodice/engine/message.hpp>

#include "batch/batch_progress.hpp"
#include "batch/batch_work.hpp"
#include "options/validators.hpp"
#include "output/terminal.hpp"

namespace bodice::inline v0_1::cli {
namespace {

struct BatchCommand {
  batch::BatchOptions batch;
  std::string manifest, out, shard = "0/1", summary;
  int threads = 1;
  bool quiet = false;
};

/// Ends the batch at the first SIGINT or SIGTERM, and the program at the second.
class StopOnSignals {
 public:
  StopOnSignals() {
    source_ = &stop_;
    struct sigaction action = {};
    action.sa_handler = [](int) { source_->cancel(); };
    action.sa_flags = static_cast<int>(SA_RESETHAND);
    for (const int signal : {SIGINT, SIGTERM}) ::sigaction(signal, &action, nullptr);
  }
  ~StopOnSignals() {
    for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, SIG_DFL);
  }
  engine::CancelToken token() const { return stop_.token(); }

 private:
  static engine::CancelSource* source_;
  engine::CancelSource stop_;
};

engine::CancelSource* StopOnSignals::source_ = nullptr;

/// "i/n", with i from 0.
engine::Result<void> read_shard(const std::string& text, batch::BatchOptions& options) {
  unsigned long long shard = 0, shards = 0;
  char after = '\0';
  if (std::sscanf(text.c_str(), "%llu/%llu%c", &shard, &shards, &after) == 2 && shard < shards) {
    options.shard = shard, options.shards = shards;
    return {};
  }
  return engine::Error{engine::ErrorCode::kInvalidArgument, "--shard: '" + text + "' is not i/n.",
                       "Give a part from 0 and the number of parts, as in 0/4."};
}

int report_end(const BatchCommand& command, const batch::BatchResult& result) {
  const batch::BatchProgress& end = result.end;
  if (!command.quiet) {
    std::printf("batch       %zu jobs in %s: %zu done, %zu there before, %zu failed\n", end.total,
                duration_text(end.seconds).c_str(), end.done, end.there, end.failed);
    std::printf("log         %s\n", result.log.c_str());
    std::fflush(stdout);
  }
  for (const std::string& failure : result.first_failures)
    std::fprintf(stderr, "bodice: failed: %s\n", failure.c_str());
  if (end.failed > result.first_failures.size())
    std::fprintf(stderr, "bodice: %zu jobs failed; %s names all.\n", end.failed, result.log.c_str());
  if (result.canceled)
    std::fprintf(stderr, "bodice: Stopped with %zu of %zu jobs to do. The same command goes on there.\n",
                 end.total - end.finished(), end.total);
  return result.canceled || end.failed > 0 ? kExitFailed : kExitOk;
}

int run(BatchCommand& command) {
  if (auto ok = read_shard(command.shard, command.batch); !ok) return fail(ok.error());
  command.batch.manifest = command.manifest;
  command.batch.out = command.out;
  if (command.batch.jobs == 0)
    command.batch.jobs = batch::jobs_side_by_side(command.threads, command.batch.memory_mb);
  const StopOnSignals signals;
  command.batch.cancel = signals.token();
  DrapeWork work(command.threads);
  BatchProgressLine progress(command.quiet);
  const auto result = batch::run_batch(work, command.batch,
                                       [&progress](const batch::BatchProgress& now) { progress.show(now); });
  progress.clear();
  return result ? report_end(command, *result) : fail(result.error());
}

int summarize(const BatchCommand& command) {
  const auto counts = batch::write_summary(command.summary);
  if (!counts) return fail(counts.error());
  if (!command.quiet) {
    std::printf("summary     %zu jobs, %zu results, %zu failed\n", counts->jobs, counts->done,
                counts->failed);
    for (const char* file : {"summary.html", "summary.csv", "summary.json", "failures.jsonl"})
      std::printf("wrote       %s\n", (std::filesystem::path(command.summary) / file).c_str());
  }
  return counts->failed > 0 ? kExitFailed : kExitOk;
}

void add_limit_options(CLI::App& sub, BatchCommand& c) {
  const auto group = "Limits of a job";
  sub.add_option("--timeout", c.batch.timeout_s, "seconds after which a job is given up (default: none)")
      ->check(above_zero())
      ->group(group);
  sub.add_option("--memory", c.batch.memory_mb, "megabytes of data that a job may have (default: no limit)")
      ->check(above_zero())
      ->group(group);
  sub.add_option("--retry", c.batch.retry,
                 "more attempts of a job that crashed, took too long or needed too much memory")
      ->check(whole(0, 100))
      ->group(group)
      ->capture_default_str();
}

}  // namespace

void add_batch_command(CLI::App& app, int& exit_code) {
  auto command = std::make_shared<BatchCommand>();
  CLI::App* sub = app.add_subcommand("batch", "Fit and drape thousands of bodies and garments");
  auto* manifest =
      sub->add_option(
             "MANIFEST", command->manifest,
             "a job a line, JSON: body, garment (a file, a list, a kind; left out: a skirt), \"only\": "
             "\"fit\", and options of drape with underscores; or .csv with the same names")
          ->check(not_empty());
  auto* out =
      sub->add_option("--out", command->out, "folder of the results: what is there is not computed again")
          ->check(not_empty());
  sub->add_option("--shard", command->shard, "i/n: only part i, from 0, of n parts")->capture_default_str();
  sub->add_option("--jobs", command->batch.jobs,
                  "jobs side by side (default: as the cores and --memory allow)")
      ->check(whole(1, 4096));
  sub->add_option("--threads", command->threads, "workers of a drape: one a job uses the cores best")
      ->check(whole(1, 1024))
      ->capture_default_str();
  add_limit_options(*sub, *command);
  sub->add_option("--summary", command->summary,
                  "write tables, failures and a page of the results in this folder, and run nothing")
      ->check(not_empty())
      ->excludes(manifest)
      ->excludes(out);
  sub->add_flag("-q,--quiet", command->quiet, "print nothing but errors");
  manifest->needs(out);
  out->needs(manifest);
  sub->footer("Example: bodice batch jobs.jsonl --out results --timeout 600 --memory 2000");
  sub->callback([command, &exit_code] {
    if (command->manifest.empty() && command->summary.empty())
      throw CLI::RequiredError("MANIFEST or --summary");
    exit_code = command->summary.empty() ? run(*command) : summarize(*command);
  });
}

}  // namespace bodice::cli
