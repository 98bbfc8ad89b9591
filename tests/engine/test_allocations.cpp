// Work of every frame must not allocate once it is warm.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include <bodice/engine/frame_pipeline.hpp>
#include <bodice/engine/parallel.hpp>
#include <bodice/engine/random.hpp>
#include <bodice/engine/task_graph.hpp>
#include <bodice/engine/trace.hpp>
#include <bodice_test/allocations.hpp>
#include <bodice_test/executors.hpp>

using namespace bodice::engine;

TEST_CASE("the allocation counter counts") {
  if (!bodice_test::counts_allocations()) return;
  const std::size_t before = bodice_test::allocations();
  const auto value = std::make_unique<std::vector<int>>(100);
  CHECK(bodice_test::allocations() - before == 2);
}

TEST_CASE("a warm bulk, parallel_for and ordered_reduce allocate nothing") {
  if (!bodice_test::counts_allocations()) return;
  for (const auto& [name, executor] : bodice_test::all_executors()) {
    CAPTURE(name);
    const Context context{.executor = executor.get()};
    std::vector<double> values(4096, 1.0);
    CHECK(bodice_test::allocations_when_warm(200, [&] {
            parallel_for(context, values.size(), 128, [&](std::size_t begin, std::size_t end) {
              parallel_for(context, end - begin, 16, [&](std::size_t b, std::size_t e) {
                for (std::size_t i = begin + b; i < begin + e; ++i) values[i] *= 0.5;
              });
            });
            values[0] = ordered_reduce(
                context, values.size(), 64, 0.0,
                [&](std::size_t begin, std::size_t end) { return values[begin] + values[end - 1]; },
                [](double a, double b) { return a + b; });
          }) == 0);
  }
}

TEST_CASE("a warm run of a task graph allocates nothing") {
  if (!bodice_test::counts_allocations()) return;
  for (const auto& [name, executor] : bodice_test::all_executors()) {
    CAPTURE(name);
    GraphBuilder builder;
    const auto in = builder.input<int>("in");
    auto next = [](const Context&, const int& value) { return value + 1; };
    std::vector<Output<int>> tasks{builder.add("root", next, in)};
    for (int i = 0; i < 30; ++i) {
      tasks.push_back(builder.add(std::to_string(i), next, tasks[static_cast<std::size_t>(i) / 3]));
    }
    auto graph = std::move(builder).build();
    std::size_t ended = 0;
    auto count = [&](const Progress& progress) { ended = progress.ended; };
    CHECK(bodice_test::allocations_when_warm(200, [&] {
            graph->set(in, 1);
            static_cast<void>(graph->run(Context{.executor = executor.get()}, count));
          }) == 0);
    CHECK(ended == 31);
  }
}

TEST_CASE("a warm frame allocates nothing, tracing included, while results arrive") {
  if (!bodice_test::counts_allocations()) return;
  for (const auto& [name, executor] : bodice_test::all_executors()) {
    CAPTURE(name);
    // The ticket's own worker may still release its memory in the first frame. Allocations of the frame
    // itself recur in every round.
    std::size_t fewest_in_first = SIZE_MAX;
    for (int round = 0; round < 20 && fewest_in_first > 0; ++round) {
      Trace trace(1 << 14);
      FramePipeline pipeline(Context{.executor = executor.get(), .trace = &trace}, {});
      Stream<int> stream(pipeline);
      auto frame = [&] {
        pipeline.frame([&](const Context& context) {
          const TraceSpan span(context, "solve");
          parallel_for(context, 64, 1, [](std::size_t, std::size_t) {});
        });
      };
      // Six results wait for the boundaries of a deterministic run; in latency mode one boundary takes all.
      const Ticket ticket = stream.submit("six", [](const Context&, Sink<int>& out) -> Result<void> {
        for (int i = 0; i < 6; ++i) out.publish(std::make_shared<const int>(i));
        return {};
      });
      REQUIRE(ticket.wait().ok());
      const std::size_t before_first = bodice_test::allocations();
      pipeline.frame([](const Context&) {});
      fewest_in_first = std::min(fewest_in_first, bodice_test::allocations() - before_first);
      CHECK(*stream.current() == 5);
      CHECK(bodice_test::allocations_when_warm(200, frame) == 0);
    }
    CHECK(fewest_in_first == 0);
  }
}
