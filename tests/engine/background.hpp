// Background work for tests of the frame pipeline.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <thread>

#include <bodice/engine/frame_pipeline.hpp>
#include <bodice/engine/hash.hpp>
#include <bodice/engine/parallel.hpp>

namespace background {

using namespace bodice::engine;

/// Waits for the condition, at most 20 s, and returns whether it came true.
template <class Condition>
bool eventually(Condition&& condition) {
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > give_up) return false;
    std::this_thread::yield();
  }
  return true;
}

/// Background work with three results; their bits depend on every block of its loops.
inline Result<void> refine(const Context& context, Sink<std::uint64_t>& out, std::uint64_t seed) {
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

}  // namespace background
