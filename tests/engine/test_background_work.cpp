#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>

#include <bodice_test/executors.hpp>

#include "background.hpp"

using namespace bodice::engine;
using background::eventually;
using background::refine;
using bodice_test::all_executors;
using bodice_test::make_threads;

TEST_CASE("a frame ends while a background block does not: the frame never waits for it") {
  const auto executor = make_threads(2);
  FramePipeline pipeline(Context{.executor = executor.get()}, {});
  Stream<int> stream(pipeline);
  std::atomic<bool> in_block{false}, release{false};
  const Ticket ticket = stream.submit("stuck", [&](const Context&, Sink<int>& out) -> Result<void> {
    in_block = true;
    CHECK(eventually([&] { return release.load(); }));  // a block of unbounded length
    out.publish(std::make_shared<const int>(1));
    return {};
  });
  REQUIRE(eventually([&] { return in_block.load(); }));
  for (int i = 0; i < 100; ++i) {
    std::atomic<int> blocks{0};
    pipeline.frame([&](const Context& context) {
      parallel_for(context, 64, 1, [&](std::size_t, std::size_t) { ++blocks; });
    });
    REQUIRE(blocks == 64);
    REQUIRE(stream.current() == nullptr);
  }
  release = true;
  CHECK(ticket.wait().ok());
}

TEST_CASE("after its current block a background thread works for the frame until the frame ends") {
  for (const BackgroundYield policy : {BackgroundYield::kStay, BackgroundYield::kHelp}) {
    const auto executor = make_threads(2);
    FramePipeline pipeline(Context{.executor = executor.get()}, {.yield = policy, .background_share = 0.0});
    Stream<int> stream(pipeline);
    std::atomic<bool> stop{false};
    std::atomic<std::uint64_t> blocks{0};
    const Ticket ticket = stream.submit("endless", [&](const Context& context, Sink<int>&) -> Result<void> {
      while (!stop) {
        context.checkpoint();
        ++blocks;
      }
      return {};
    });
    REQUIRE(eventually([&] { return blocks > 0; }));
    std::atomic<int> arrived{0};
    pipeline.frame([&](const Context& context) {
      // The two blocks wait for each other: they need a second thread, which is in the background job.
      parallel_for(context, 2, 1, [&](std::size_t, std::size_t) {
        ++arrived;
        CHECK(eventually([&] { return arrived == 2; }));
      });
      if (policy == BackgroundYield::kStay) {
        const std::uint64_t before = blocks;
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        CHECK(blocks <= before + 1);
      }
    });
    stop = true;
    CHECK(ticket.wait().ok());
  }
}

TEST_CASE("a worker that is kept for the background goes on during frames") {
  const auto executor = make_threads(2);
  FramePipeline pipeline(Context{.executor = executor.get()}, {.frame_workers = 1});
  Stream<int> stream(pipeline);
  std::atomic<bool> stop{false};
  std::atomic<std::uint64_t> blocks{0};
  const Ticket ticket = stream.submit("endless", [&](const Context& context, Sink<int>&) -> Result<void> {
    for (; !stop; ++blocks) context.checkpoint();
    return {};
  });
  pipeline.frame([&](const Context& context) {
    CHECK(context.executor->concurrency() == 1);
    const std::uint64_t before = blocks;
    CHECK(eventually([&] { return blocks > before + 1000; }));
  });
  stop = true;
  CHECK(ticket.wait().ok());
}

TEST_CASE("background work moves on even where frames follow one another without a gap") {
  const auto executor = make_threads(2);
  FramePipeline pipeline(Context{.executor = executor.get()}, {});
  Stream<std::uint64_t> stream(pipeline);
  const Ticket ticket = stream.submit(
      "body", [](const Context& context, Sink<std::uint64_t>& out) { return refine(context, out, 1); });
  CHECK(eventually([&] {
    pipeline.frame([](const Context& context) {
      parallel_for(context, 16, 1, [](std::size_t, std::size_t) {
        std::this_thread::sleep_for(std::chrono::microseconds(10));
      });
    });
    return ticket.done();
  }));
}

TEST_CASE("a new body cancels the work for the old one, of which nothing appears any more") {
  for (const auto& [name, executor] : all_executors()) {
    if (name == "host, inside enqueue") continue;  // this host ends a job before submit returns
    CAPTURE(name);
    FramePipeline pipeline(Context{.executor = executor.get()}, {});
    Stream<int> stream(pipeline);
    std::atomic<bool> superseded{false};
    const Ticket old = stream.submit("old", [&](const Context& context, Sink<int>& out) -> Result<void> {
      eventually([&] { return superseded.load(); });
      for (;;) {
        context.checkpoint();
        out.publish(std::make_shared<const int>(-1));
      }
    });
    const Ticket fresh = stream.submit("fresh", [](const Context&, Sink<int>& out) -> Result<void> {
      out.publish(std::make_shared<const int>(1));
      return {};
    });
    superseded = true;
    CHECK(old.wait().error().code == ErrorCode::kCanceled);
    CHECK(fresh.wait().ok());
    pipeline.frame([&](const Context&) { CHECK(*stream.current() == 1); });
  }
}

TEST_CASE("an error or exception of a job is in its ticket and in the log, and no result takes effect") {
  struct Lines final : Log {
    void write(LogLevel, std::string_view message) override { text += std::string(message) + "\n"; }
    std::string text;
  } log;
  FramePipeline pipeline(Context{.log = &log}, {});
  Stream<int> stream(pipeline);
  const Ticket error = stream.submit("first", [](const Context&, Sink<int>&) -> Result<void> {
    return Error{ErrorCode::kUnusableGeometry, "The body has no legs.", "Check the mesh."};
  });
  CHECK(error.wait().error().code == ErrorCode::kUnusableGeometry);
  const Ticket thrown = stream.submit(
      "second", [](const Context&, Sink<int>&) -> Result<void> { throw std::runtime_error("out of cloth"); });
  pipeline.run_pending();
  CHECK(thrown.done());
  CHECK(thrown.wait().error().message == "'second' failed: out of cloth.");
  CHECK(log.text == "The body has no legs. Check the mesh.\n'second' failed: out of cloth.\n");
  pipeline.frame([&](const Context&) { CHECK(stream.current() == nullptr); });
}

TEST_CASE("with one worker a ticket may be awaited inside a frame; with any, once its pipeline is gone") {
  for (const auto& [name, executor] : all_executors()) {
    CAPTURE(name);
    Ticket kept;
    {
      FramePipeline pipeline(Context{.executor = executor.get()}, {});
      Stream<std::uint64_t> stream(pipeline);
      pipeline.frame([&](const Context&) {
        const Ticket ticket = stream.submit("inside", [](const Context& context, Sink<std::uint64_t>& out) {
          return refine(context, out, 5);
        });
        if (executor->concurrency() == 1) CHECK(ticket.wait().ok());
      });
      if (name == "host, inside enqueue") continue;  // this host's submit would run it to its end
      kept = stream.submit("endless", [](const Context& context, Sink<std::uint64_t>&) -> Result<void> {
        for (const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
             std::chrono::steady_clock::now() < end;)
          context.checkpoint();
        return {};
      });
    }
    CHECK(kept.done());
  }
}
