// An executor on the host's own job system.
#pragma once

#include <memory>

#include <bodice/engine/executor.hpp>
#include <bodice/engine/result.hpp>

namespace bodice::inline v0_1::engine {

/// The host's job system as plain functions, all thread-safe and without exceptions.
///
/// bodice never waits for a task that has not started: the calling thread does all work that is left, and a
/// task that starts too late does nothing. So a run cannot hang: the host may run a task inside enqueue, on
/// any thread, in any order, late, or only inside finish.
struct HostCallbacks {
  void* host = nullptr;  ///< passed to the functions below
  int concurrency = 1;   ///< bodies that may run at the same time, the calling thread's included
  /// A bound on tasks of this executor that are enqueued and not finished yet. A task that the host has not
  /// begun stays enqueued after its call has returned, and counts; where there are as many, calls enqueue no
  /// more and run on the calling thread.
  int max_tasks_in_flight = 64;

  /// Arranges for run(task) to be called once. `name` is static or lives until the task has run.
  /// Returns a handle for finish.
  void* (*enqueue)(void* host, const char* name, void (*run)(void* task), void* task) = nullptr;
  /// Returns when that run(task) has returned, and frees the handle. Called once for each handle: while the
  /// task runs or after; for tasks that never started, only when the executor is destroyed.
  void (*finish)(void* host, void* handle) = nullptr;
};

/// Makes an executor of the callbacks. Fails with kInvalidArgument if a function is missing or a number is
/// below 1. The host's threads must still run tasks while the executor is destroyed.
Result<std::unique_ptr<Executor>> make_host_executor(const HostCallbacks& callbacks);

}  // namespace bodice::engine
