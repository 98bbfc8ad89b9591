#include "base/thread_pool.hpp"

namespace bodice::inline v0_1::capi {

ThreadPool::ThreadPool(int threads, int most_tasks)
    : tasks_(static_cast<std::size_t>(most_tasks)), queue_(tasks_.size()) {
  for (std::uint32_t i = 0; i < tasks_.size(); ++i) free_.push_back(i);
  threads_.reserve(static_cast<std::size_t>(threads));
  try {
    for (int i = 0; i < threads; ++i) threads_.emplace_back([this] { work(); });
  } catch (...) {  // the system gives no more threads; those that run must end before they are destroyed
    end();
    throw;
  }
}

ThreadPool::~ThreadPool() {
  end();
}

void ThreadPool::end() {
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
  }
  queued_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

engine::HostCallbacks ThreadPool::callbacks() {
  return {
      .host = this,
      .concurrency = static_cast<int>(threads_.size()) + 1,
      .max_tasks_in_flight = static_cast<int>(tasks_.size()),
      .enqueue = [](void* pool, const char*, void (*run)(void*), void* task) -> void* {
        return static_cast<ThreadPool*>(pool)->enqueue(run, task);
      },
      .finish = [](void* pool,
                   void* handle) { static_cast<ThreadPool*>(pool)->wait_for(*static_cast<Task*>(handle)); }};
}

void* ThreadPool::enqueue(void (*run)(void*), void* argument) {
  Task* task = nullptr;
  {
    const std::lock_guard lock(mutex_);
    const std::uint32_t at = free_.back();  // the executor's bound on tasks in flight leaves one free
    free_.pop_back();
    task = &tasks_[at];
    *task = {run, argument, false};
    queue_[(first_ + waiting_++) % queue_.size()] = at;
  }
  queued_.notify_one();
  return task;
}

void ThreadPool::wait_for(Task& task) {
  std::unique_lock lock(mutex_);
  ended_.wait(lock, [&] { return task.done; });
  free_.push_back(static_cast<std::uint32_t>(&task - tasks_.data()));
}

void ThreadPool::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    queued_.wait(lock, [&] { return waiting_ > 0 || closing_; });
    if (waiting_ == 0) return;
    Task& task = tasks_[queue_[first_]];
    first_ = (first_ + 1) % queue_.size();
    --waiting_;
    lock.unlock();
    task.run(task.argument);
    lock.lock();
    task.done = true;
    ended_.notify_all();
  }
}

}  // namespace bodice::capi
