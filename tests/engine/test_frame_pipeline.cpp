#include <doctest/doctest.h>

#include <array>
#include <atomic>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <bodice/engine/hash.hpp>
#include <bodice/engine/trace.hpp>
#include <bodice_test/executors.hpp>

#include "background.hpp"

using namespace bodice::engine;
using background::eventually;
using background::refine;
using bodice_test::all_executors;
using bodice_test::make_threads;

namespace {

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

TEST_CASE("in every loop of a frame a thread begins with the same half of the indices") {
  const auto executor = make_threads(2);
  FramePipeline pipeline(Context{.executor = executor.get()}, {});
  const std::thread::id no_thread{};
  std::array<std::thread::id, 2> owner{no_thread, no_thread};
  for (int loop = 0; loop < 50; ++loop) {
    std::array<std::thread::id, 8> ran;
    std::array<std::atomic<bool>, 2> begun{false, false};
    std::atomic<int> started{0};
    pipeline.frame([&](const Context& context) {
      parallel_for(context, ran.size(), 1, [&](std::size_t i, std::size_t) {
        const int order = started++;
        ran[i] = std::this_thread::get_id();
        // Both threads wait for the first index of the other one, so that neither can take it.
        if (i % 4 != 0) return;
        CHECK(order < 2);
        begun[i / 4] = true;
        CHECK(eventually([&] { return begun[1 - i / 4].load(); }));
      });
    });
    for (std::size_t half = 0; half < 2; ++half) {
      if (owner[half] == no_thread) owner[half] = ran[4 * half];
      REQUIRE(ran[4 * half] == owner[half]);
    }
  }
  CHECK(owner[0] != owner[1]);
}

TEST_CASE("a loop of a frame throws the exception of the least index that fails, on every executor") {
  for (const auto& [name, executor] : all_executors()) {
    CAPTURE(name);
    FramePipeline pipeline(Context{.executor = executor.get()}, {});
    for (int repeat = 0; repeat < 50; ++repeat) {
      std::atomic<int> before{0};
      const auto run = [&] {
        pipeline.frame([&](const Context& context) {
          parallel_for(context, 100, 1, [&](std::size_t i, std::size_t) {
            if (i == 45 || i == 50 || i == 99) throw std::runtime_error(std::to_string(i));
            before += i < 45;
          });
        });
      };
      REQUIRE_THROWS_WITH_AS(run(), "45", std::runtime_error);
      REQUIRE(before == 45);
    }
  }
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
    const auto until = std::chrono::steady_clock::now() + std::chrono::microseconds(random.below(60));
    while (std::chrono::steady_clock::now() < until) {
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
