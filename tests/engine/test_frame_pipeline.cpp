#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <bodice/engine/frame_pipeline.hpp>
#include <bodice/engine/hash.hpp>
#include <bodice/engine/parallel.hpp>
#include <bodice/engine/trace.hpp>
#include <bodice_test/executors.hpp>

using namespace bodice::engine;
using bodice_test::all_executors;
using bodice_test::make_threads;

namespace {

using Clock_ = std::chrono::steady_clock;

template <class Condition>
bool eventually(Condition&& condition) {
  const auto give_up = Clock_::now() + std::chrono::seconds(20);
  while (!condition()) {
    if (Clock_::now() > give_up) return false;
    std::this_thread::yield();
  }
  return true;
}

// Background work with three results; their bits depend on every block of its loops.
Result<void> refine(const Context& context, Sink<std::uint64_t>& out, std::uint64_t seed) {
  std::uint64_t sum = seed;
  for (int level = 0; level < 3; ++level) {
    sum = ordered_reduce(
        context, 4000, 64, sum,
        [&](std::size_t begin, std::size_t end) {
          std::uint64_t part = seed;
          for (std::size_t i = begin; i < end; ++i) part = mix64(part ^ i);
          return part;
        },
        [](std::uint64_t a, std::uint64_t b) { return mix64(a + b); });
    out.publish(std::make_shared<const std::uint64_t>(sum));
  }
  return {};
}

// Runs forty frames over two bodies, and returns the hash of what each frame saw and made.
std::uint64_t run_session(Executor& executor, PipelineMode mode) {
  FramePipeline pipeline(Context{.executor = &executor}, {.mode = mode, .delay_frames = 3});
  Stream<std::uint64_t> proxy(pipeline);
  Hasher hasher;
  std::vector<std::uint64_t> particles(1000);
  for (int frame = 0; frame < 40; ++frame) {
    if (frame == 2 || frame == 15) {
      const auto seed = static_cast<std::uint64_t>(frame);
      proxy.submit("body", [seed](const Context& context, Sink<std::uint64_t>& out) {
        return refine(context, out, seed);
      });
    }
    const FrameTiming report = pipeline.frame([&](const Context& context) {
      const std::uint64_t now = proxy.current() ? *proxy.current() : 0;
      parallel_for(context, particles.size(), 50, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) particles[i] = mix64(particles[i] + now + i);
      });
    });
    hasher.add(report.index);
    hasher.add(std::span<const std::uint64_t>(particles));
  }
  return hasher.value();
}

}  // namespace

TEST_CASE("deterministic mode: the frames have the same bits on every executor") {
  const std::uint64_t expected = run_session(inline_executor(), PipelineMode::kDeterministic);
  for (const auto& [name, executor] : all_executors()) {
    CAPTURE(name);
    for (int repeat = 0; repeat < 3; ++repeat) {
      CHECK(run_session(*executor, PipelineMode::kDeterministic) == expected);
    }
  }
}

TEST_CASE("deterministic mode: result k of a job takes effect (k + 1) delays after its submission") {
  for (const auto& [name, executor] : all_executors()) {
    CAPTURE(name);
    FramePipeline pipeline(Context{.executor = executor.get()},
                           {.mode = PipelineMode::kDeterministic, .delay_frames = 2});
    Stream<int> stream(pipeline);
    std::string seen;
    auto frames = [&](int count) {
      for (int i = 0; i < count; ++i) {
        pipeline.frame(
            [&](const Context&) { seen += stream.current() ? std::to_string(*stream.current()) : "-"; });
      }
    };
    auto submit = [&](int first, int last) {
      return stream.submit("count", [=](const Context&, Sink<int>& out) -> Result<void> {
        for (int i = first; i <= last; ++i) out.publish(std::make_shared<const int>(i));
        return {};
      });
    };
    frames(1);
    submit(1, 3);
    frames(9);
    submit(4, 9);
    frames(3);
    submit(7, 7);  // replaces 4..9, of which 4 has taken effect
    frames(4);
    CHECK(seen ==
          "-"
          "--1122333"
          "334"
          "4477");
  }
}

TEST_CASE("latency mode: results appear at boundaries only, newest first, and never go back") {
  for (const auto& [name, executor] : all_executors()) {
    CAPTURE(name);
    FramePipeline pipeline(Context{.executor = executor.get()}, {});
    Stream<int> stream(pipeline);
    const Ticket ticket = stream.submit("count", [](const Context& context, Sink<int>& out) -> Result<void> {
      for (int i = 1; i <= 500; ++i) {
        out.publish(std::make_shared<const int>(i));
        parallel_for(context, 4, 1, [](std::size_t, std::size_t) {});
      }
      return {};
    });
    int last = 0;
    bool steady = true;
    auto frame = [&] {
      pipeline.frame([&](const Context& context) {
        const int at_start = stream.current() ? *stream.current() : 0;
        parallel_for(context, 8, 1, [](std::size_t, std::size_t) {});
        steady = steady && at_start >= last && (stream.current() ? *stream.current() : 0) == at_start;
        last = at_start;
      });
    };
    for (int i = 0; i < 50; ++i) frame();
    REQUIRE(ticket.wait().ok());
    frame();
    CHECK(last == 500);
    CHECK(steady);
  }
}

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
        for (const auto end = Clock_::now() + std::chrono::seconds(20); Clock_::now() < end;)
          context.checkpoint();
        return {};
      });
    }
    CHECK(kept.done());
  }
}

TEST_CASE("an exception of the frame's body is rethrown, and the next frame runs") {
  const auto executor = make_threads(3);
  FramePipeline pipeline(Context{.executor = executor.get()}, {});
  CHECK_THROWS_WITH(pipeline.frame([](const Context& context) {
    parallel_for(context, 100, 1, [](std::size_t begin, std::size_t) {
      if (begin == 40) throw std::runtime_error("frame");
    });
  }),
                    "frame");
  std::atomic<int> blocks{0};
  pipeline.frame([&](const Context& context) {
    parallel_for(context, 10, 1, [&](std::size_t, std::size_t) {
      parallel_for(context, 10, 1, [&](std::size_t, std::size_t) { ++blocks; });  // a loop inside a loop
    });
  });
  CHECK(blocks == 100);
}

TEST_CASE("a thousand cancellations at random moments: results are whole, and old or new") {
  struct Pair {
    std::uint64_t seed, hash;
  };
  const auto executor = make_threads(3);
  FramePipeline pipeline(Context{.executor = executor.get()}, {});
  Stream<Pair> stream(pipeline);
  Random random(11);
  std::uint64_t last_seen = 0;
  bool whole = true, never_back = true, none_of_canceled = true;
  for (std::uint64_t i = 1; i <= 1000; ++i) {
    Ticket ticket = stream.submit("body", [i](const Context& context, Sink<Pair>& out) -> Result<void> {
      std::vector<std::uint64_t> blocks(16);
      for (int level = 0; level < 5; ++level) {
        parallel_for(context, 16, 1,
                     [&](std::size_t block, std::size_t) { blocks[block] = mix64(i + block); });
        out.publish(std::make_shared<const Pair>(Pair{i, mix64(i)}));
      }
      return {};
    });
    const auto until = Clock_::now() + std::chrono::microseconds(random.below(60));
    while (Clock_::now() < until) {
    }
    const bool by_hand = random.below(2) == 0;
    if (by_hand)
      ticket.cancel();
    else if (i % 50 == 0)
      CHECK(ticket.wait().ok());  // on a busy machine no other may get so far
    pipeline.frame([&](const Context&) {
      if (!stream.current()) return;
      const Pair now = *stream.current();
      whole = whole && now.hash == mix64(now.seed);
      never_back = never_back && now.seed >= last_seen;
      none_of_canceled = none_of_canceled && !(by_hand && now.seed == i);
      last_seen = now.seed;
    });
  }
  CHECK(whole);
  CHECK(never_back);
  CHECK(none_of_canceled);
  CHECK(last_seen > 0);
}

TEST_CASE("frames and jobs appear in the trace under their names") {
  Trace trace(64);
  FramePipeline pipeline(Context{.trace = &trace}, {});
  Stream<int> stream(pipeline);
  CHECK(stream.submit("fit", [](const Context&, Sink<int>&) -> Result<void> { return {}; }).wait().ok());
  pipeline.frame([](const Context&) {});
  const auto events = trace.events();
  REQUIRE(events.size() == 2);
  CHECK(std::string(events[0].name) == "fit");
  CHECK(std::string(events[1].name) == "frame");
  CHECK(events[1].value == 0);
}
