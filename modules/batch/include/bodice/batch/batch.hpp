// A manifest to results: every job in a process of its own, every result whole or absent.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <bodice/batch/work.hpp>
#include <bodice/engine/cancel.hpp>

namespace bodice::inline v0_1::batch {

/// How a batch runs.
struct BatchOptions {
  std::filesystem::path manifest = {};  ///< JSON lines, or CSV where the name ends in .csv
  std::filesystem::path out = {};       ///< folder of the results; made if it is missing
  std::size_t shard = 0;                ///< which of `shards` parts of the manifest to run, from 0
  std::size_t shards = 1;
  int jobs = 0;            ///< jobs side by side; 0: available_cores()
  double timeout_s = 0.0;  ///< for a job with its share in the common step, as if it ran alone; 0: no limit
  double memory_mb = 0.0;  ///< for a job's data, 10^6 bytes each; 0: no limit
  int retry = 0;           ///< more attempts of a job that crashed, took too long or needed too much memory
  engine::CancelToken cancel = {};  ///< ends the batch within a second; running jobs leave nothing behind
};

/// Where a batch stands.
struct BatchProgress {
  std::size_t lines = 0;   ///< lines of the whole manifest
  std::size_t total = 0;   ///< jobs of this shard
  std::size_t done = 0;    ///< computed by this run
  std::size_t there = 0;   ///< skipped: the result was there, from another line or an earlier run
  std::size_t failed = 0;  ///< jobs that this run gave up
  double seconds = 0.0;    ///< since the begin
  double left_s = -1.0;    ///< expected time to the end, by the rate of jobs so far; negative: not known yet
  std::size_t finished() const { return done + there + failed; }
};

/// How a batch ended.
struct BatchResult {
  BatchProgress end;
  bool canceled = false;
  std::filesystem::path log;                ///< a JSON line a job; see the page of this layer
  std::vector<std::string> first_failures;  ///< up to ten: the line, and why
};

/// Called after every event, at least five times a second while jobs run.
using BatchWatcher = std::function<void(const BatchProgress&)>;

/// Runs the jobs of a shard that have no result yet. Jobs that fail, crash, hang or need too much memory end
/// as a line of the log, and the others go on. Fails with kInvalidArgument (shards), kNotFound or kUnreadable
/// (the manifest, not one of its lines) and kWriteFailed: a full disk stops the batch, since every further
/// job would end there. Memory: some 30 bytes a line of the manifest, and the children. Precondition: the
/// process has one thread.
engine::Result<BatchResult> run_batch(Work& work, const BatchOptions& options,
                                      const BatchWatcher& watcher = {});

/// The cores that this process may use: those it is bound to, less where a control group or Slurm
/// (SLURM_CPUS_PER_TASK) grants fewer; at least 1.
int available_cores();

/// What a batch of such jobs keeps busy: the available cores by the workers of a job, or fewer where
/// `memory_mb` a job (0: no limit) would not fit the memory that is available now; at least 1.
int jobs_side_by_side(int workers_a_job, double memory_mb);

}  // namespace bodice::batch
