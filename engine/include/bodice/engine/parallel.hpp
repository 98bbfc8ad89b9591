// Data-parallel loops with the same bits for any number of workers.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include <bodice/engine/context.hpp>

namespace bodice::inline v0_1::engine {

/// The number of blocks of at most `grain` elements. It depends on count and grain only, never on the
/// workers.
inline std::size_t block_count(std::size_t count, std::size_t grain) {
  return grain == 0 ? 0 : count / grain + (count % grain != 0);
}

/// Calls body(begin, end) for consecutive blocks of at most `grain` elements that cover [0, count).
/// Blocks run in any order; the body must write only to memory that belongs to its block.
/// Throws what a body threw, or Canceled. A single block runs on the caller without a task.
/// Choose the grain so that a block costs 20 us or more (engine/MEASUREMENTS.md, What a task costs).
template <class Body>
void parallel_for(const Context& context, std::size_t count, std::size_t grain, Body&& body) {
  const std::size_t blocks = block_count(count, grain);
  auto run_block = [&](std::size_t block) {
    context.checkpoint();
    const std::size_t begin = block * grain;
    body(begin, begin + std::min(grain, count - begin));
  };
  if (blocks == 1) return run_block(0);
  if (blocks > 1) context.executor->bulk(blocks, run_block);
}

/// ordered_reduce() with the caller's memory: room for block_count(count, grain) partial results or more.
template <class T, class Map, class Combine>
T ordered_reduce_in(const Context& context, std::size_t count, std::size_t grain, T identity, Map&& map,
                    Combine&& combine, std::span<T> partial) {
  parallel_for(context, count, grain,
               [&](std::size_t begin, std::size_t end) { partial[begin / grain] = map(begin, end); });
  T total = std::move(identity);
  for (T& part : partial.first(block_count(count, grain))) total = combine(std::move(total), std::move(part));
  return total;
}

/// Reduces the blocks' partial results in block order: sum = combine(sum, map(begin, end)), from `identity`.
/// The bits are the same for any number of workers, because neither the blocks nor the order depend on them.
/// Up to 64 blocks of a plain type up to 64 bytes need no allocation.
template <class T, class Map, class Combine>
T ordered_reduce(const Context& context, std::size_t count, std::size_t grain, T identity, Map&& map,
                 Combine&& combine) {
  constexpr std::size_t kOnStack = 64;
  const std::size_t blocks = block_count(count, grain);
  if constexpr (std::is_trivially_copyable_v<T> && sizeof(T) <= 64) {
    if (blocks <= kOnStack) {
      alignas(T) std::array<std::byte, kOnStack * sizeof(T)> bytes;
      T* const first = reinterpret_cast<T*>(bytes.data());
      std::uninitialized_fill_n(first, blocks, identity);
      return ordered_reduce_in(context, count, grain, identity, map, combine, std::span<T>(first, blocks));
    }
  }
  std::vector<T> partial(blocks, identity);
  return ordered_reduce_in(context, count, grain, std::move(identity), map, combine, std::span<T>(partial));
}

}  // namespace bodice::engine
