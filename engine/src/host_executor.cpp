#include <bodice/engine/host_executor.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <vector>

#include "index_loop.hpp"

namespace bodice::inline v0_1::engine {
namespace {

// The state of a task lent to the host. Usually: free -> reserved -> queued -> running -> ended, after which
// its bulk frees it. If the bulk is over before the task began: queued -> revoked -> collectable, after which
// the next thread that needs a task finishes its handle and frees it. Background tasks have no bulk and end
// as collectable.
enum class TaskState { kFree, kReserved, kQueued, kRunning, kEnded, kRevoked, kCollectable };

struct HostTask {
  std::atomic<TaskState> state{TaskState::kFree};
  IndexLoop* loop = nullptr;
  std::shared_ptr<BackgroundTask> background;
  std::atomic<int> background_holds{0};  // 2: the host runs it, and enqueue has not returned its handle
  void* handle = nullptr;

  void release_background() {
    if (background_holds.fetch_sub(1) == 1) state.store(TaskState::kCollectable);
  }
};

void run_host_task(void* argument) {
  HostTask& task = *static_cast<HostTask*>(argument);
  TaskState expected = TaskState::kQueued;
  if (!task.state.compare_exchange_strong(expected, TaskState::kRunning)) {
    task.state.store(TaskState::kCollectable);
  } else if (task.loop) {
    task.loop->work();
    task.state.store(TaskState::kEnded);
  } else {
    task.background->run();
    task.background.reset();
    task.release_background();
  }
}

class HostExecutor final : public Executor {
 public:
  explicit HostExecutor(const HostCallbacks& callbacks)
      : callbacks_(callbacks), tasks_(static_cast<std::size_t>(callbacks.max_tasks_in_flight)) {}

  ~HostExecutor() override {
    for (HostTask& task : tasks_) {
      if (task.state.load() != TaskState::kFree) callbacks_.finish(callbacks_.host, task.handle);
    }
  }

  int concurrency() const noexcept override { return callbacks_.concurrency; }

  void bulk(std::size_t count, FunctionRef<void(std::size_t)> body) override {
    IndexLoop loop(count, body);
    // The number of a bulk's helpers is bounded, so that their list fits on the stack.
    std::array<HostTask*, 128> helpers;
    const std::size_t wanted = std::min({count, static_cast<std::size_t>(concurrency()), helpers.size()});
    std::size_t lent = 0;
    while (lent + 1 < wanted && (helpers[lent] = reserve())) {
      enqueue(*helpers[lent], "bodice bulk", &loop, nullptr);
      ++lent;
    }
    loop.work();
    for (std::size_t i = 0; i < lent; ++i) leave(*helpers[i]);
    loop.rethrow();
  }

  bool start(std::shared_ptr<BackgroundTask> task) override {
    HostTask* lent = concurrency() > 1 ? reserve() : nullptr;
    if (!lent) return false;
    const char* name = task->name();
    enqueue(*lent, name, nullptr, std::move(task));
    lent->release_background();
    return true;
  }

 private:
  HostTask* reserve() {
    for (HostTask& task : tasks_) {
      collect(task);
      TaskState expected = TaskState::kFree;
      if (task.state.compare_exchange_strong(expected, TaskState::kReserved)) return &task;
    }
    return nullptr;
  }

  void enqueue(HostTask& task, const char* name, IndexLoop* loop,
               std::shared_ptr<BackgroundTask> background) {
    task.loop = loop;
    task.background = std::move(background);
    task.background_holds.store(2);
    task.state.store(TaskState::kQueued);
    task.handle = callbacks_.enqueue(callbacks_.host, name, &run_host_task, &task);
  }

  // The bulk is over: waits for the helper if it is in the loop, else revokes its task.
  void leave(HostTask& task) {
    TaskState expected = TaskState::kQueued;
    if (task.state.compare_exchange_strong(expected, TaskState::kRevoked)) return;
    callbacks_.finish(callbacks_.host, task.handle);
    task.state.store(TaskState::kFree);
  }

  void collect(HostTask& task) {
    TaskState expected = TaskState::kCollectable;
    if (!task.state.compare_exchange_strong(expected, TaskState::kReserved)) return;
    callbacks_.finish(callbacks_.host, task.handle);
    task.state.store(TaskState::kFree);
  }

  HostCallbacks callbacks_;
  std::vector<HostTask> tasks_;
};

}  // namespace

Result<std::unique_ptr<Executor>> make_host_executor(const HostCallbacks& callbacks) {
  if (!callbacks.enqueue || !callbacks.finish) {
    return Error{ErrorCode::kInvalidArgument, "The host's job system lacks enqueue or finish.",
                 "Set both functions of HostCallbacks."};
  }
  if (callbacks.concurrency < 1 || callbacks.max_tasks_in_flight < 1) {
    return Error{ErrorCode::kInvalidArgument,
                 "The host's concurrency or bound on tasks in flight is below 1.", "Set both to at least 1."};
  }
  return std::unique_ptr<Executor>(std::make_unique<HostExecutor>(callbacks));
}

}  // namespace bodice::engine
