#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>

#include <bodice/engine/host_executor.hpp>
#include <bodice/engine/parallel.hpp>
#include <bodice_test/executors.hpp>

using namespace bodice::engine;
using bodice_test::all_executors;
using bodice_test::HostOrder;
using bodice_test::make_test_host;

namespace {

struct Flag final : BackgroundTask {
  const char* name() const noexcept override { return "flag"; }
  void run() noexcept override { ++runs; }
  std::atomic<int> runs{0};
};

void wait_until(const std::atomic<int>& value, int wanted) {
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (value < wanted && std::chrono::steady_clock::now() < give_up) std::this_thread::yield();
}

}  // namespace

TEST_CASE("bulk calls the body once for each index, nested three deep, on every executor") {
  for (const auto& [name, executor] : all_executors()) {
    CAPTURE(name);
    CHECK(executor->concurrency() >= 1);
    std::vector<std::atomic<int>> calls(7 * 11 * 13);
    executor->bulk(7, [&](std::size_t i) {
      executor->bulk(11, [&](std::size_t j) {
        executor->bulk(13, [&](std::size_t k) { ++calls[(i * 11 + j) * 13 + k]; });
      });
    });
    for (const auto& count : calls) REQUIRE(count == 1);
    executor->bulk(0, [&](std::size_t) { FAIL("no index to call"); });
  }
}

TEST_CASE("no more bodies run at once than the executor's concurrency") {
  for (const auto& [name, executor] : all_executors()) {
    CAPTURE(name);
    std::atomic<int> now{0}, most{0};
    executor->bulk(200, [&](std::size_t) {
      const int running = ++now;
      for (int seen = most; running > seen && !most.compare_exchange_weak(seen, running);) {
      }
      std::this_thread::yield();
      --now;
    });
    CHECK(most <= executor->concurrency());
  }
}

TEST_CASE("of several exceptions that of the least index is rethrown, and the executor still works") {
  for (const auto& [name, executor] : all_executors()) {
    CAPTURE(name);
    for (int repeat = 0; repeat < 50; ++repeat) {
      std::string what;
      try {
        executor->bulk(100, [](std::size_t i) {
          if (i % 10 == 7) throw std::runtime_error(std::to_string(i));
        });
      } catch (const std::runtime_error& error) {
        what = error.what();
      }
      REQUIRE(what == "7");
    }
    std::atomic<int> calls{0};
    executor->bulk(100, [&](std::size_t) { ++calls; });
    CHECK(calls == 100);
  }
}

TEST_CASE("an exception of a nested bulk reaches the outermost caller") {
  for (const auto& [name, executor] : all_executors()) {
    CAPTURE(name);
    CHECK_THROWS_WITH(executor->bulk(8,
                                     [&](std::size_t i) {
                                       executor->bulk(8, [&](std::size_t j) {
                                         if (i == 3 && j == 5) throw std::runtime_error("inner");
                                       });
                                     }),
                      "inner");
  }
}

TEST_CASE("canceling stops parallel_for before the blocks that have not started") {
  for (const auto& [name, executor] : all_executors()) {
    CAPTURE(name);
    CancelSource parent;
    CancelSource source(parent.token());
    const Context context{.executor = executor.get(), .cancel = source.token()};
    std::atomic<int> blocks{0};
    auto cancel_first = [&](std::size_t, std::size_t) {
      ++blocks;
      parent.cancel();
    };
    CHECK_THROWS_AS(parallel_for(context, 100'000, 1, cancel_first), Canceled);
    CHECK(blocks <= executor->concurrency());
    CHECK_THROWS_AS(parallel_for(context, 1, 1, cancel_first), Canceled);
  }
}

TEST_CASE("many callers share one executor") {
  for (const auto& [name, executor] : all_executors()) {
    CAPTURE(name);
    Executor* const shared = executor.get();
    std::atomic<int> calls{0};
    std::vector<std::thread> callers;
    for (int caller = 0; caller < 3; ++caller) {
      callers.emplace_back([&] {
        for (int repeat = 0; repeat < 50; ++repeat) shared->bulk(20, [&](std::size_t) { ++calls; });
      });
    }
    for (std::thread& caller : callers) caller.join();
    CHECK(calls == 3 * 50 * 20);
  }
}

TEST_CASE("a started task runs once, or is refused at once") {
  for (auto& [name, executor] : all_executors()) {
    CAPTURE(name);
    const auto task = std::make_shared<Flag>();
    const bool lazy = name == "host, on finish";
    const bool taken = executor->start(task);
    CHECK(taken == (executor->concurrency() > 1));
    if (taken && !lazy) wait_until(task->runs, 1);
    if (lazy) CHECK(task->runs == 0);
    executor.reset();  // waits for the started tasks
    CHECK(task->runs == (taken ? 1 : 0));
  }
}

TEST_CASE("a host is never lent more tasks than the bound, and gets every handle back") {
  struct Counting {
    std::atomic<int> in_flight{0}, most{0}, enqueued{0};
  } host;
  HostCallbacks callbacks;
  callbacks.host = &host;
  callbacks.concurrency = 8;
  callbacks.max_tasks_in_flight = 5;
  callbacks.finish = [](void* self, void*) { --static_cast<Counting*>(self)->in_flight; };
  callbacks.enqueue = [](void* self, const char* name, void (*run)(void*), void* task) -> void* {
    CHECK(std::string(name) == "bodice bulk");
    auto& counts = *static_cast<Counting*>(self);
    const int now = ++counts.in_flight;
    if (now > counts.most) counts.most = now;
    if (++counts.enqueued % 2 == 0) run(task);  // runs every other task at once, and the rest never
    return task;
  };
  {
    const auto executor = std::move(make_host_executor(callbacks)).value();
    int calls = 0;
    for (int repeat = 0; repeat < 20; ++repeat) executor->bulk(10, [&](std::size_t) { ++calls; });
    CHECK(calls == 200);
    CHECK(host.most <= 5);
  }
  CHECK(host.in_flight == 0);
}

TEST_CASE("a host without functions or workers is refused with a sentence") {
  CHECK(make_host_executor({}).error().code == ErrorCode::kInvalidArgument);
  HostCallbacks callbacks;
  callbacks.enqueue = [](void*, const char*, void (*)(void*), void* task) { return task; };
  callbacks.finish = [](void*, void*) {};
  callbacks.concurrency = 0;
  CHECK(make_host_executor(callbacks).error().message.find("below 1") != std::string::npos);
}

#ifndef __SANITIZE_THREAD__
TEST_CASE("the waiting caller helps a loop nested in another thread's body") {
  // Body 0 is short. Body 1 holds a nested loop of bodies that wait for one another: they can only end when
  // the thread that waits for the outer bulk takes one of them.
  const auto executor = make_tbb_executor(2);
  for (int repeat = 0; repeat < 20; ++repeat) {
    std::atomic<int> arrived{0};
    executor->bulk(2, [&](std::size_t i) {
      if (i == 0) return;
      executor->bulk(2, [&](std::size_t) {
        ++arrived;
        wait_until(arrived, 2);
      });
    });
    CHECK(arrived == 2);
  }
}

TEST_CASE("a thread that waits in bulk never runs work of another outermost bulk") {
  const auto executor = make_tbb_executor(3);
  std::atomic<bool> stop{false};
  const auto frame_thread = std::this_thread::get_id();
  std::atomic<int> strangers{0};
  std::thread other([&] {
    while (!stop) {
      executor->bulk(30, [&](std::size_t) {
        if (std::this_thread::get_id() == frame_thread) ++strangers;
        std::this_thread::sleep_for(std::chrono::microseconds(50));
      });
    }
  });
  for (int repeat = 0; repeat < 300; ++repeat) {
    executor->bulk(3, [](std::size_t) { std::this_thread::sleep_for(std::chrono::microseconds(20)); });
  }
  stop = true;
  other.join();
  CHECK(strangers == 0);
}
#endif
