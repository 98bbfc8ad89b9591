// What a batch runs. The layer schedules, isolates and stores jobs, and does not depend on what they compute.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <bodice/batch/job.hpp>
#include <bodice/engine/result.hpp>

namespace bodice::inline v0_1::batch {

/// The facts that the log states of a job that succeeded.
struct JobFacts {
  std::uint64_t seed = 0;
  std::vector<engine::Warning> warnings;
  /// Measured numbers by name; names carry a unit. `error_mm` sorts the summary, the largest first.
  std::vector<std::pair<std::string, double>> numbers;
};

/// The result of the step that several jobs share, ready to run each of them.
class PreparedJobs {
 public:
  virtual ~PreparedJobs() = default;
  /// Runs one job, in a process of its own that starts as a copy of the one that prepared it, and writes its
  /// outputs into `folder`, which is there and empty. May throw; may crash.
  virtual engine::Result<JobFacts> run(const Job& job, const std::filesystem::path& folder) = 0;
};

/// The work of a batch. Its functions are called by one thread. prepare() and run() are called in child
/// processes, which copy this one without its threads: before they are, no thread may have been started.
class Work {
 public:
  virtual ~Work() = default;
  /// Part of every result's name: results of another version are not reused.
  virtual std::string version() const = 0;
  /// Whether this value of this name is the name of a file to read. Such files count by their content.
  virtual bool is_file(const std::string& name, const std::string& value) const = 0;
  /// The files that hold a part of this one, beside it. They count by their content, too.
  virtual std::vector<std::filesystem::path> files_beside(const std::filesystem::path& file) const = 0;
  /// Jobs with the same text share what prepare() gives.
  virtual std::string shared(const Job& job) const = 0;
  /// Fails where the job cannot be run as it is written. Reads no files.
  virtual engine::Result<void> check(const Job& job) const = 0;
  /// The step that all jobs with the same shared() text have in common; `first` is one of them.
  virtual engine::Result<std::unique_ptr<PreparedJobs>> prepare(const Job& first) = 0;
};

}  // namespace bodice::batch
