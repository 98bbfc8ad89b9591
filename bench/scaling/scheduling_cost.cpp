#include "scheduling_cost.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <string>

#include <oneapi/tbb/flow_graph.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_reduce.h>
#include <oneapi/tbb/task_arena.h>

#include <bodice/engine/parallel.hpp>
#include <bodice/engine/task_graph.hpp>

namespace bodice_bench {
namespace {

using namespace bodice::engine;
using Range = tbb::blocked_range<std::size_t>;

double ns_of(const std::function<void()>& call, std::size_t units) {
  const auto begin = std::chrono::steady_clock::now();
  call();
  const std::chrono::duration<double, std::nano> spent = std::chrono::steady_clock::now() - begin;
  return spent.count() / static_cast<double>(units);
}

Cost compare(std::string what, std::string unit, std::size_t units, int repeats,
             const std::function<void()>& engine, const std::function<void()>& raw) {
  std::vector<double> engine_ns, raw_ns;
  engine();
  raw();
  for (int i = 0; i < repeats; ++i) {
    engine_ns.push_back(ns_of(engine, units));
    raw_ns.push_back(ns_of(raw, units));
  }
  std::ranges::sort(engine_ns);
  std::ranges::sort(raw_ns);
  return {std::move(what),           std::move(unit),   engine_ns[engine_ns.size() / 2],
          raw_ns[raw_ns.size() / 2], engine_ns.front(), raw_ns.front()};
}

double term(std::size_t i) {
  return std::sqrt(static_cast<double>(i));
}

Cost graph_cost(const Context& context, tbb::task_arena& arena, int repeats) {
  constexpr int kTasks = 1000;
  GraphBuilder builder;
  const auto root = builder.add("root", [](const Context&) { return 0; });
  for (int i = 0; i < kTasks; ++i)
    builder.add(
        "task " + std::to_string(i), [](const Context&, const int&) {}, root);
  auto graph = std::move(builder).build();
  std::vector<tbb::flow::continue_node<tbb::flow::continue_msg>> nodes;
  nodes.reserve(kTasks);
  std::unique_ptr<tbb::flow::graph> raw;
  std::unique_ptr<tbb::flow::broadcast_node<tbb::flow::continue_msg>> start;
  arena.execute([&] {
    raw = std::make_unique<tbb::flow::graph>();
    start = std::make_unique<tbb::flow::broadcast_node<tbb::flow::continue_msg>>(*raw);
    for (int i = 0; i < kTasks; ++i) {
      nodes.emplace_back(*raw, [](const tbb::flow::continue_msg&) {});
      tbb::flow::make_edge(*start, nodes.back());
    }
  });
  return compare(
      "empty task of a graph (raw: flow_graph)", "ns", kTasks, repeats,
      [&] { static_cast<void>(graph->run(context)); },
      [&] {
        arena.execute([&] {
          start->try_put(tbb::flow::continue_msg());
          raw->wait_for_all();
        });
      });
}

}  // namespace

std::vector<Cost> scheduling_costs(int workers, int repeats) {
  const auto executor = make_tbb_executor(workers);
  const Context context{.executor = executor.get()};
  tbb::task_arena arena(workers);
  auto nothing = [](std::size_t, std::size_t) {};
  std::vector<Cost> costs;
  for (const std::size_t tasks : {2u, 100u, 100'000u}) {
    const bool one_loop = tasks <= 100;
    costs.push_back(compare(
        one_loop ? "a loop of " + std::to_string(tasks) + " empty tasks" : "an empty task of a long loop",
        one_loop ? "ns a loop" : "ns", one_loop ? 1 : tasks, repeats * (one_loop ? 20 : 1),
        [&] { parallel_for(context, tasks, 1, nothing); },
        [&] {
          arena.execute([&] {
            tbb::parallel_for(
                Range(0, tasks, 1), [](const Range&) {}, tbb::simple_partitioner{});
          });
        }));
  }
  costs.push_back(graph_cost(context, arena, repeats));
  constexpr std::size_t kTerms = 1'000'000, kGrain = 8192;
  volatile double sink = 0.0;
  costs.push_back(compare(
      "cost of determinism: ordered_reduce (raw: parallel_reduce)", "ns a term", kTerms, repeats,
      [&] {
        sink = ordered_reduce(
            context, kTerms, kGrain, 0.0,
            [](std::size_t begin, std::size_t end) {
              double s = 0.0;
              for (std::size_t i = begin; i < end; ++i) s += term(i);
              return s;
            },
            std::plus<>());
      },
      [&] {
        arena.execute([&] {
          sink = tbb::parallel_reduce(
              Range(0, kTerms, kGrain), 0.0,
              [](const Range& range, double s) {
                for (std::size_t i = range.begin(); i < range.end(); ++i) s += term(i);
                return s;
              },
              std::plus<>());
        });
      }));
  static_cast<void>(sink);
  return costs;
}

}  // namespace bodice_bench
