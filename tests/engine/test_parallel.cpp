#include <doctest/doctest.h>

#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <bodice/engine/parallel.hpp>
#include <bodice_test/executors.hpp>

using namespace bodice::engine;

namespace {

// A sum with a value that depends on the order of additions.
double harmonic(Executor& executor, std::size_t count, std::size_t grain) {
  const Context context{.executor = &executor};
  return ordered_reduce(
      context, count, grain, 0.0,
      [](std::size_t begin, std::size_t end) {
        double s = 0.0;
        for (std::size_t i = begin; i < end; ++i) s += 1.0 / static_cast<double>(i + 1);
        return s;
      },
      std::plus<>());
}

}  // namespace

TEST_CASE("ordered_reduce gives the same bits on every executor, on the stack and beyond") {
  for (const std::size_t grain : {1000u, 10'000u}) {
    const double serial = harmonic(inline_executor(), 100'000, grain);
    for (const auto& [name, executor] : bodice_test::all_executors()) {
      CAPTURE(name);
      for (int repeat = 0; repeat < 5; ++repeat) CHECK(harmonic(*executor, 100'000, grain) == serial);
    }
  }
}

TEST_CASE(
    "ordered_reduce_in uses the memory that the caller gives, also if it is larger than needed and not "
    "empty") {
  const auto length = [](std::size_t begin, std::size_t end) { return static_cast<int>(end - begin); };
  for (const auto& [name, executor] : bodice_test::all_executors()) {
    CAPTURE(name);
    const Context context{.executor = executor.get()};
    std::vector<int> room(12, 1000);
    CHECK(ordered_reduce_in(context, 95, 10, 5, length, std::plus<>(), std::span(room)) == 100);
    CHECK(room[10] == 1000);
    CHECK(ordered_reduce_in(context, 0, 10, 5, length, std::plus<>(), std::span(room)) == 5);
  }
}

TEST_CASE("ordered_reduce combines in block order, also for types that own memory") {
  for (const auto& [name, executor] : bodice_test::all_executors()) {
    CAPTURE(name);
    const Context context{.executor = executor.get()};
    const std::string text = ordered_reduce(
        context, 7, 2, std::string("<"),
        [](std::size_t begin, std::size_t end) { return std::to_string(begin) + std::to_string(end) + " "; },
        std::plus<>());
    CHECK(text == "<02 24 46 67 ");
  }
}

TEST_CASE("parallel_for covers the range in blocks of the grain, whatever the numbers") {
  constexpr std::size_t kHuge = std::numeric_limits<std::size_t>::max();
  for (const std::size_t count : {0u, 1u, 2u, 63u, 64u, 65u, 1000u}) {
    for (const std::size_t grain : {std::size_t{1}, std::size_t{7}, std::size_t{64}, kHuge}) {
      std::size_t next = 0;
      parallel_for(Context{}, count, grain, [&](std::size_t begin, std::size_t end) {
        CHECK(begin == next);
        CHECK(end - begin <= grain);
        next = end;
      });
      CHECK(next == count);
    }
  }
  CHECK(block_count(kHuge, 1) == kHuge);
  CHECK(block_count(10, 0) == 0);
}
