// Executors run tasks. Layers start no thread but those of the TBB executor that the caller makes; the
// C interface has threads of a context and of a ticket besides.
#pragma once

#include <cstddef>
#include <memory>

#include <bodice/engine/function_ref.hpp>

namespace bodice::inline v0_1::engine {

/// Work that may run on after the call that started it (Executor::start).
class BackgroundTask {
 public:
  virtual ~BackgroundTask() = default;
  /// The task's name in traces and in the host's profiler; valid as long as the task.
  virtual const char* name() const noexcept = 0;
  /// Does the work. An executor calls it once, on any of its workers.
  virtual void run() noexcept = 0;
};

/// Runs bodies of work. Thread-safe; `bulk` may be called from inside `bulk`.
class Executor {
 public:
  virtual ~Executor() = default;

  /// The upper bound on bodies that run at the same time, the caller's included; 1 for the inline executor.
  virtual int concurrency() const noexcept = 0;

  /// Calls body(i) once for each i in [0, count), in any order and on any worker, and returns when all
  /// have ended. If some throw, none with a larger i starts, and the exception of the least i is rethrown
  /// after the running ones ended: the same one in every run. Bodies start in order of i, except in the
  /// loops of a frame, where each worker begins with another range of indices (engine/FRAMES.md). A thread
  /// that waits runs only bodies of the same outermost bulk (engine/README.md, Threads).
  virtual void bulk(std::size_t count, FunctionRef<void(std::size_t)> body) = 0;

  /// Has another worker call task->run() once, and returns at once. Returns false, without taking the task,
  /// if no worker can be spared. The executor must outlive the run.
  virtual bool start(std::shared_ptr<BackgroundTask> task) {
    static_cast<void>(task);
    return false;
  }

  /// A point at which long work lets more urgent work go first. Most executors do nothing here.
  virtual void yield() noexcept {}
};

/// The serial executor: it runs everything on the calling thread, in order.
Executor& inline_executor() noexcept;

/// Makes a TBB arena with the given number of workers, the caller included; 0 means one a hardware thread.
/// More workers than hardware threads raise TBB's process-wide limit for the executor's lifetime. Its
/// destructor waits for started tasks.
std::unique_ptr<Executor> make_tbb_executor(int concurrency = 0);

/// Makes an executor in the TBB arena of the calling thread, with its concurrency, for hosts that use TBB.
std::unique_ptr<Executor> make_attached_tbb_executor();

}  // namespace bodice::engine
