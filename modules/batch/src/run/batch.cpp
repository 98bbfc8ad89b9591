#include <bodice/batch/batch.hpp>

#include <chrono>

#include <sys/utsname.h>
#include <unistd.h>

#include "run/coordinator.hpp"

namespace bodice::inline v0_1::batch {
namespace {

namespace fs = std::filesystem;

/// What the first line of a log states. `manifest` and `started_ns` are what a summary goes by.
engine::SortedJson header(const Work& work, const BatchOptions& options, const Manifest& manifest) {
  std::error_code ignored;
  const auto since_epoch = std::chrono::system_clock::now().time_since_epoch();
  return {{"run",
           {{"manifest", fs::weakly_canonical(options.manifest, ignored).string()},
            {"lines", manifest.lines()},
            {"shard", options.shard},
            {"shards", options.shards},
            {"jobs", manifest.size()},
            {"version", work.version()},
            {"host", host_name()},
            {"started_ns", std::chrono::duration_cast<std::chrono::nanoseconds>(since_epoch).count()}}}};
}

}  // namespace

engine::Result<BatchResult> run_batch(Work& work, const BatchOptions& options, const BatchWatcher& watcher) {
  auto manifest = Manifest::open(options.manifest, work, {options.shard, options.shards}, options.cancel);
  if (!manifest) return std::move(manifest).error();
  auto store = ResultStore::open(options.out);
  if (!store) return std::move(store).error();
  auto log =
      Log::open(store->logs(), std::to_string(options.shard) + "-of-" + std::to_string(options.shards));
  if (!log) return std::move(log).error();
  if (auto done = log->add(header(work, options, *manifest)); !done) return std::move(done).error();
  const int jobs = options.jobs > 0 ? options.jobs : available_cores();
  return Coordinator({work, *manifest, *store, options}, *log, watcher, jobs).run();
}

}  // namespace bodice::batch
