// Threads of a context that has no job system of the host.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>
#include <vector>

#include <bodice/engine/host_executor.hpp>

namespace bodice::inline v0_1::capi {

/// A few threads behind the callbacks of a host executor. A task allocates nothing.
class ThreadPool {
 public:
  /// Starts `threads` threads; at most `most_tasks` tasks are enqueued and not finished at a time. Throws
  /// std::system_error where the system gives no more threads.
  ThreadPool(int threads, int most_tasks);
  /// Runs what is enqueued, and ends the threads.
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  engine::HostCallbacks callbacks();

 private:
  struct Task {
    void (*run)(void*) = nullptr;
    void* argument = nullptr;
    bool done = false;
  };
  void* enqueue(void (*run)(void*), void* argument);
  void wait_for(Task& task);
  void work();
  void end();

  std::mutex mutex_;
  std::condition_variable queued_, ended_;
  std::vector<Task> tasks_;
  std::vector<std::uint32_t> free_, queue_;  ///< indices of tasks; the queue is a ring
  std::size_t first_ = 0, waiting_ = 0;      ///< the queue's front and length
  bool closing_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace bodice::capi
