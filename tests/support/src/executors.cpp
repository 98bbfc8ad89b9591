#include <bodice_test/executors.hpp>

#include <condition_variable>
#include <mutex>
#include <thread>

#include <doctest/doctest.h>
#include <bodice/engine/host_executor.hpp>
#include <bodice/engine/random.hpp>

namespace bodice_test {
namespace {

using namespace bodice::engine;

struct Job {
  void (*run)(void*) = nullptr;
  void* task = nullptr;
  bool used = false, taken = false, ended = false;
};

class TestHost {
 public:
  TestHost(HostOrder order, int threads, std::uint64_t seed, int max_in_flight)
      : order_(order), random_(seed), jobs_(static_cast<std::size_t>(max_in_flight)) {
    queue_.reserve(jobs_.size());
    if (order != HostOrder::kRandom) return;
    for (int i = 0; i < threads; ++i) threads_.emplace_back([this] { serve(); });
  }
  ~TestHost() {
    {
      const std::lock_guard lock(mutex_);
      stop_ = true;
    }
    changed_.notify_all();
    for (std::thread& thread : threads_) thread.join();
  }

  void* enqueue(void (*run)(void*), void* task) {
    Job* job = nullptr;
    {
      const std::lock_guard lock(mutex_);
      for (job = jobs_.data(); job->used;) ++job;  // the executor promises to stay below the bound
      *job = {run, task, true};
      if (order_ != HostOrder::kInside) queue_.push_back(job);
    }
    if (order_ == HostOrder::kInside) {
      run(task);
      const std::lock_guard lock(mutex_);
      job->taken = job->ended = true;
    }
    changed_.notify_all();
    return job;
  }

  void finish(Job* job) {
    std::unique_lock lock(mutex_);
    if (order_ == HostOrder::kOnFinish && !job->taken) {
      std::erase(queue_, job);
      run_unlocked(job, lock);
    }
    changed_.wait(lock, [&] { return job->ended; });
    job->used = false;
  }

 private:
  void run_unlocked(Job* job, std::unique_lock<std::mutex>& lock) {
    job->taken = true;
    lock.unlock();
    job->run(job->task);
    lock.lock();
    job->ended = true;
    changed_.notify_all();
  }

  void serve() {
    std::unique_lock lock(mutex_);
    for (;;) {
      changed_.wait(lock, [this] { return stop_ || !queue_.empty(); });
      if (queue_.empty()) return;
      const auto chosen = queue_.begin() + static_cast<std::ptrdiff_t>(random_.below(queue_.size()));
      Job* job = *chosen;
      queue_.erase(chosen);
      run_unlocked(job, lock);
    }
  }

  HostOrder order_;
  Random random_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Job> jobs_;
  std::vector<Job*> queue_;
  bool stop_ = false;
  std::vector<std::thread> threads_;
};

// An executor that owns its host, and forwards all calls to the executor on it.
class HostedExecutor final : public Executor {
 public:
  HostedExecutor(HostOrder order, int concurrency, std::uint64_t seed, int max_in_flight)
      : host_(order, concurrency - 1, seed, max_in_flight) {
    HostCallbacks callbacks;
    callbacks.host = &host_;
    callbacks.concurrency = concurrency;
    callbacks.max_tasks_in_flight = max_in_flight;
    callbacks.enqueue = [](void* host, const char*, void (*run)(void*), void* task) {
      return static_cast<TestHost*>(host)->enqueue(run, task);
    };
    callbacks.finish = [](void* host, void* job) {
      static_cast<TestHost*>(host)->finish(static_cast<Job*>(job));
    };
    executor_ = std::move(make_host_executor(callbacks)).value();
  }
  int concurrency() const noexcept override { return executor_->concurrency(); }
  void bulk(std::size_t count, FunctionRef<void(std::size_t)> body) override { executor_->bulk(count, body); }
  bool start(std::shared_ptr<BackgroundTask> task) override { return executor_->start(std::move(task)); }

 private:
  TestHost host_;
  std::unique_ptr<Executor> executor_;
};

class Inline final : public Executor {
 public:
  int concurrency() const noexcept override { return 1; }
  void bulk(std::size_t count, FunctionRef<void(std::size_t)> body) override {
    inline_executor().bulk(count, body);
  }
};

}  // namespace

std::unique_ptr<Executor> make_test_host(HostOrder order, int concurrency, std::uint64_t seed,
                                         int max_in_flight) {
  return std::make_unique<HostedExecutor>(order, concurrency, seed, max_in_flight);
}

std::unique_ptr<Executor> make_threads(int concurrency) {
#ifdef __SANITIZE_THREAD__
  return make_test_host(HostOrder::kRandom, concurrency);
#else
  return make_tbb_executor(concurrency);
#endif
}

std::vector<NamedExecutor> all_executors() {
  std::vector<NamedExecutor> all;
  all.emplace_back("inline", std::make_unique<Inline>());
#ifndef __SANITIZE_THREAD__
  for (const int workers : {1, 2, 3, 7}) {
    all.emplace_back("tbb " + std::to_string(workers), make_tbb_executor(workers));
  }
  all.emplace_back("tbb attached", make_attached_tbb_executor());
#endif
  for (const int workers : {2, 3, 7}) {
    all.emplace_back("host, random order, " + std::to_string(workers),
                     make_test_host(HostOrder::kRandom, workers, static_cast<std::uint64_t>(workers)));
  }
  all.emplace_back("host, inside enqueue", make_test_host(HostOrder::kInside, 4));
  all.emplace_back("host, on finish", make_test_host(HostOrder::kOnFinish, 4));
  all.emplace_back("host, one task in flight", make_test_host(HostOrder::kRandom, 3, 1, 1));
  return all;
}

}  // namespace bodice_test
