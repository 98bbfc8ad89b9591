// Gives the jobs of a manifest to fitters, and writes down how they ended.
#pragma once

#include <deque>
#include <list>
#include <map>
#include <optional>

#include "process/outcome.hpp"
#include "results/result_key.hpp"
#include "run/fitter.hpp"
#include "run/log.hpp"

namespace bodice::inline v0_1::batch {

/// A job that has to run.
struct Task {
  std::size_t index = 0;  ///< in the manifest's order
  Job job;
  std::string key;
  int attempts = 0;
  bool computed = false;  ///< its result waits for the disk alone
};

/// A fitter and the jobs that share its step.
struct Crew {
  pid_t process = -1;
  ChannelEnd channel;
  LineReader reader;
  std::optional<Outcome> prepared;  ///< how the shared step ended; absent: not yet
  double begin_s = 0.0;
  bool late = false;
  int starts = 0;
  std::size_t next = 0, end = 0;        ///< jobs that were not looked at yet
  std::deque<Task> waiting;             ///< jobs to run before those
  std::map<std::size_t, Task> running;  ///< by line
  bool is_ready() const { return prepared && prepared->failure == Failure::kNone; }
};

class Coordinator {
 public:
  Coordinator(const FitterContext& context, Log& log, const BatchWatcher& watcher, int most_jobs);
  ~Coordinator();

  /// Runs until no job is left, or until it is canceled. Fails where going on makes no sense.
  engine::Result<BatchResult> run();

 private:
  void fill();
  bool give_next(Crew& crew);
  bool open_crew();
  void start(Crew& crew);
  std::optional<Task> next_task(Crew& crew);
  std::optional<Task> examine(std::size_t index);
  /// Jobs and shared steps that take a core. Results that wait for the disk take none, up to as many as there
  /// may be jobs: a slow disk must not collect them.
  int busy() const;

  void wait();
  void hear(Crew& crew, const engine::SortedJson& message);
  void finish(Task task, const Outcome& outcome, Crew& crew);
  /// Handles a fitter that has ended. Returns whether its crew is done.
  bool bury(Crew& crew);
  void fail_all(Crew& crew, const Outcome& outcome);
  void dismiss(Crew& crew);
  void stop_late_fits();

  void write(engine::SortedJson line);
  void write_failure(std::size_t index, const Task* task, const Outcome& outcome);
  void show();

  FitterContext context_;
  Log& log_;
  const BatchWatcher& watcher_;
  int most_jobs_;
  FileHashes files_;
  std::list<Crew> crews_;
  std::size_t cursor_ = 0;  ///< jobs from here on belong to no crew yet
  BatchResult result_;
  std::optional<engine::Error> fatal_;
  double begin_s_;
};

}  // namespace bodice::batch
