#include <doctest/doctest.h>

#include <atomic>
#include <numeric>
#include <string>
#include <vector>

#include <bodice/engine/random.hpp>
#include <bodice/engine/task_graph.hpp>
#include <bodice_test/executors.hpp>

#include "numbered.hpp"

using namespace bodice::engine;

namespace {

Result<int> halve(const Context&, const int& value) {
  if (value % 2 == 0) return value / 2;
  return Error{ErrorCode::kInvalidArgument, std::to_string(value) + " is odd.", "Give an even number."};
}

}  // namespace

TEST_CASE("a graph passes typed values on, and runs again with another input") {
  for (const auto& [name, executor] : bodice_test::all_executors()) {
    CAPTURE(name);
    GraphBuilder builder;
    const auto number = builder.input<int>("number");
    const auto half = builder.add("halve", halve, number);
    const auto text = builder.add(
        "format",
        [](const Context&, const int& a, const int& b) {
          return std::to_string(a) + "/" + std::to_string(b);
        },
        half, number);
    auto graph = std::move(builder).build();
    REQUIRE(graph.ok());
    CHECK(graph->size() == 2);
    const Context context{.executor = executor.get()};

    auto unset = graph->run(context);
    REQUIRE(!unset.ok());
    CHECK(unset.error().message.find("'number'") != std::string::npos);

    graph->set(number, 10);
    REQUIRE(graph->run(context).ok());
    CHECK(graph->get(text) == "5/10");
    graph->set(number, 7);
    const auto odd = graph->run(context);
    REQUIRE(!odd.ok());
    CHECK(odd.error().message == "7 is odd.");
    CHECK(graph->find(text) == nullptr);  // a text of the first run must not remain in the second
    graph->set(number, 8);
    REQUIRE(graph->run(context).ok());
    CHECK(graph->get(text) == "4/8");
    CHECK(graph->take(text) == "4/8");
    CHECK(graph->find(text) == nullptr);
    REQUIRE(graph->run(context).ok());
    CHECK(graph->get(text) == "4/8");
    CHECK(graph->take(number) == 8);
    CHECK(!graph->run(context).ok());  // an input that was taken must be set again
  }
}

TEST_CASE("a graph far wider and deeper than its workers runs each task once") {
  constexpr int kLayers = 40, kWide = 150;  // above 4,096 tasks the ready set has two words of leaves
  for (const auto& [name, executor] : bodice_test::all_executors()) {
    CAPTURE(name);
    GraphBuilder builder;
    std::vector<Output<int>> layer;
    for (int i = 0; i < kWide; ++i) {
      layer.push_back(builder.add("0/" + std::to_string(i), [i](const Context&) { return i; }));
    }
    for (int l = 1; l < kLayers; ++l) {
      std::vector<Output<int>> next;
      for (int i = 0; i < kWide; ++i) {
        next.push_back(builder.add(
            std::to_string(l) + "/" + std::to_string(i),
            [](const Context&, const int& a, const int& b) { return (a + b) % 1009; }, layer[i],
            layer[(i * 7 + l) % kWide]));
      }
      layer = next;
    }
    auto graph = std::move(builder).build();
    REQUIRE(graph.ok());
    std::vector<int> expected(kWide);
    std::iota(expected.begin(), expected.end(), 0);
    for (int l = 1; l < kLayers; ++l) {
      const std::vector<int> before = expected;
      for (int i = 0; i < kWide; ++i) expected[i] = (before[i] + before[(i * 7 + l) % kWide]) % 1009;
    }
    for (int run = 0; run < 3; ++run) {
      std::size_t ended = 0;
      REQUIRE(
          graph->run(Context{.executor = executor.get()}, [&](const Progress& p) { ended = p.ended; }).ok());
      CHECK(ended == kLayers * kWide);
      bool same = true;
      for (int i = 0; i < kWide; ++i) same = same && graph->get(layer[i]) == expected[i];
      CHECK(same);
    }
  }
}

TEST_CASE("an empty graph runs") {
  auto graph = GraphBuilder().build();
  REQUIRE(graph.ok());
  CHECK(graph->run(Context{}).ok());
}

TEST_CASE("random graphs: every task runs once, after all that it needs, on any executor") {
  for (const auto& [name, executor] : bodice_test::all_executors()) {
    CAPTURE(name);
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      Random random(seed);
      GraphBuilder builder;
      std::vector<Output<std::uint64_t>> tasks;
      std::vector<std::uint64_t> expected;
      std::atomic<int> runs{0};
      for (std::uint64_t i = 0; i < 60; ++i) {
        auto hash = [i, &runs](const Context&, const auto&... in) {
          ++runs;
          return mix64((in + ... + i));
        };
        if (i < 3) {
          tasks.push_back(builder.add(numbered("t", i), hash));
          expected.push_back(mix64(i));
        } else {
          const std::size_t a = random.below(i), b = random.below(i);
          tasks.push_back(builder.add(numbered("t", i), hash, tasks[a], tasks[b]));
          expected.push_back(mix64(expected[a] + expected[b] + i));
        }
        builder.set_priority(tasks.back(), static_cast<int>(random.below(3)));
      }
      auto graph = std::move(builder).build();
      REQUIRE(graph.ok());
      for (int run = 0; run < 3; ++run) {
        runs = 0;
        REQUIRE(graph->run(Context{.executor = executor.get()}).ok());
        CHECK(runs == 60);
        for (std::size_t i = 0; i < tasks.size(); ++i) REQUIRE(graph->get(tasks[i]) == expected[i]);
      }
    }
  }
}

TEST_CASE("a deep graph of barriers neither overflows the stack nor stops early") {
  // Each task of 500 layers needs all four tasks of the layer before: the worst case for nesting.
  const auto executor = bodice_test::make_threads(3);
  GraphBuilder builder;
  std::vector<Output<int>> layer;
  auto sum = [](const Context&, const auto&... in) { return (0 + ... + in) % 1000 + 1; };
  for (int t = 0; t < 4; ++t) layer.push_back(builder.add(numbered("layer ", t), sum));
  for (int depth = 1; depth < 500; ++depth) {
    std::vector<Output<int>> next;
    for (int t = 0; t < 4; ++t) {
      next.push_back(
          builder.add(numbered("layer ", depth * 4 + t), sum, layer[0], layer[1], layer[2], layer[3]));
    }
    layer = next;
  }
  auto graph = std::move(builder).build();
  REQUIRE(graph.ok());
  REQUIRE(graph->run(Context{}).ok());
  const int serial = graph->get(layer[3]);
  for (int run = 0; run < 5; ++run) {
    REQUIRE(graph->run(Context{.executor = executor.get()}).ok());
    CHECK(graph->get(layer[3]) == serial);
  }
}

TEST_CASE("ready tasks start by priority; progress rises by one") {
  GraphBuilder builder;
  std::string started;
  const auto root = builder.add("root", [](const Context&) { return 0; });
  for (const char letter : std::string("abcd")) {
    const auto task = builder.add(
        std::string(1, letter), [&, letter](const Context&, const int&) { started += letter; }, root);
    builder.set_priority(task, letter == 'c' ? 2 : letter == 'b' ? 1 : 0);
  }
  auto graph = std::move(builder).build();
  std::vector<std::size_t> steps;
  auto note = [&](const Progress& progress) {
    CHECK(progress.total == 5);
    steps.push_back(progress.ended);
  };
  REQUIRE(graph->run(Context{}, note).ok());
  CHECK(started == "cbad");
  CHECK(steps == std::vector<std::size_t>{1, 2, 3, 4, 5});
}

TEST_CASE("order() makes a task wait without taking data; add_into keeps its memory") {
  GraphBuilder builder;
  std::string log;
  const auto last = builder.add("last", [&](const Context&) { log += "last"; });
  const auto first = builder.add("first", [&](const Context&) { log += "first "; });
  builder.order(first, last);
  const int* data = nullptr;
  const auto kept = builder.add_into<std::vector<int>>("fill", [&](const Context&, std::vector<int>& out) {
    out.assign(100, 1);
    data = out.data();
  });
  auto graph = std::move(builder).build();
  REQUIRE(graph->run(Context{}).ok());
  CHECK(log == "first last");
  const int* first_data = data;
  REQUIRE(graph->run(Context{}).ok());
  CHECK(data == first_data);
  CHECK(graph->get(kept).size() == 100);
}

TEST_CASE("the DOT text names every task and edge") {
  GraphBuilder builder;
  const auto in = builder.input<int>("in \"put\"");
  builder.add("out", halve, in);
  const std::string dot = std::move(builder).build()->dump_dot();
  CHECK(dot ==
        "digraph tasks {\n  rankdir=LR;\n  \"in \\\"put\\\"\" [shape=box];\n  \"out\";\n"
        "  \"in \\\"put\\\"\" -> \"out\";\n}\n");
}
