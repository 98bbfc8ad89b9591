#include <doctest/doctest.h>

#include <atomic>
#include <stdexcept>
#include <string>

#include <bodice/engine/task_graph.hpp>
#include <bodice_test/executors.hpp>

#include "numbered.hpp"

using namespace bodice::engine;

namespace {

std::string build_error(GraphBuilder&& builder) {
  auto graph = std::move(builder).build();
  REQUIRE(!graph.ok());
  CHECK(graph.error().code == ErrorCode::kInvalidArgument);
  CHECK(!graph.error().remedy.empty());
  return graph.error().message;
}

}  // namespace

TEST_CASE("mistakes in a graph are errors that name the tasks") {
  auto one = [](const Context&) { return 1; };
  auto next = [](const Context&, const int& value) { return value + 1; };
  {
    GraphBuilder builder;
    const auto a = builder.declare<int>("alpha");
    const auto b = builder.add("beta", next, a);
    builder.add("gamma", next, b);
    builder.define(a, next, b);
    const std::string message = build_error(std::move(builder));
    CHECK(message.find("'alpha' -> 'beta' -> 'alpha'") != std::string::npos);
    CHECK(message.find("gamma") == std::string::npos);
  }
  {
    GraphBuilder builder;
    const auto a = builder.add("self", one);
    builder.order(a, a);
    CHECK(build_error(std::move(builder)).find("'self' -> 'self'") != std::string::npos);
  }
  {
    GraphBuilder builder;
    builder.add("twin", one);
    builder.add("twin", one);
    CHECK(build_error(std::move(builder)).find("'twin'") != std::string::npos);
  }
  {
    GraphBuilder builder;
    builder.add("user", next, builder.declare<int>("ghost"));
    const std::string message = build_error(std::move(builder));
    CHECK(message.find("'ghost'") != std::string::npos);
    CHECK(message.find("'user'") != std::string::npos);
  }
  {
    GraphBuilder other, builder;
    const auto stranger = other.add("stranger", one);
    builder.add("first", one);
    builder.add("user", next, stranger);
    CHECK(build_error(std::move(builder)).find("'user'") != std::string::npos);
  }
  {
    GraphBuilder other, builder;
    const auto stranger = other.declare<int>("stranger");
    builder.declare<int>("own");
    builder.define(stranger, one);
    CHECK(build_error(std::move(builder)).find("another graph") != std::string::npos);
  }
  {
    GraphBuilder builder;
    const auto a = builder.add("again", one);
    builder.define(a, one);
    CHECK(build_error(std::move(builder)).find("'again'") != std::string::npos);
  }
}

TEST_CASE("which of several errors is reported does not depend on timing") {
  for (const auto& [name, executor] : bodice_test::all_executors()) {
    CAPTURE(name);
    GraphBuilder builder;
    for (int i = 0; i < 16; ++i) {
      builder.add(numbered("t", i), [i](const Context&) -> Result<int> {
        if (i < 5) return i;
        return Error{ErrorCode::kUnreadable, numbered("task ", i), ""};
      });
    }
    auto graph = std::move(builder).build();
    for (int run = 0; run < 50; ++run) {
      const auto result = graph->run(Context{.executor = executor.get()});
      REQUIRE(!result.ok());
      REQUIRE(result.error().message == "task 5");
    }
  }
}

TEST_CASE("an exception of a task is rethrown, and the graph can run again") {
  GraphBuilder builder;
  bool fail = true;
  const auto task = builder.add("throws", [&](const Context&) {
    if (fail) throw std::runtime_error("disk on fire");
    return 1;
  });
  auto graph = std::move(builder).build();
  CHECK_THROWS_WITH(static_cast<void>(graph->run(Context{})), "disk on fire");
  CHECK(graph->find(task) == nullptr);
  fail = false;
  CHECK(graph->run(Context{}).ok());
}

TEST_CASE("a canceled run names the task where it stopped and starts no more tasks") {
  for (const auto& [name, executor] : bodice_test::all_executors()) {
    CAPTURE(name);
    CancelSource source;
    GraphBuilder builder;
    std::atomic<int> late{0};
    const auto first = builder.add("first", [&](const Context&) {
      source.cancel();
      return 1;
    });
    builder.add(
        "second", [&](const Context&, const int&) { return ++late; }, first);
    auto graph = std::move(builder).build();
    const auto result = graph->run(Context{.executor = executor.get(), .cancel = source.token()});
    REQUIRE(!result.ok());
    CHECK(result.error().code == ErrorCode::kCanceled);
    CHECK(result.error().message.find("'second'") != std::string::npos);
    CHECK(late == 0);
  }
}
