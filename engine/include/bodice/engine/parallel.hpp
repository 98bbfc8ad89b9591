// Data-parallel loops whose results have the same bits for any number of workers.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include <bodice/engine/context.hpp>

namespace bodice::engine {

/// Number of blocks of at most `grain` elements; depends on count and grain only, never on the workers.
inline std::size_t block_count(std::size_t count, std::size_t grain) {
  return grain == 0 ? 0 : (count + grain - 1) / grain;
}

/// Calls body(begin, end) for consecutive blocks of at most `grain` elements that cover [0, count).
/// Blocks run in any order; the body must write only to places that belong to its block.
/// Throws what a body threw, or Cancelled. A single block runs on the caller without a task.
template <class Body>
void parallel_for(const Context& context, std::size_t count, std::size_t grain, Body&& body) {
  const std::size_t blocks = block_count(count, grain);
  auto run_block = [&](std::size_t block) {
    context.cancel.check();
    const std::size_t begin = block * grain;
    body(begin, std::min(begin + grain, count));
  };
  if (blocks == 1) return run_block(0);
  if (blocks > 1) context.executor->bulk(blocks, run_block);
}

/// Reduces the blocks' partial results in block order: sum = combine(sum, map(begin, end)), from `identity`.
/// The same bits for any number of workers, because neither the blocks nor the order depend on them.
template <class T, class Map, class Combine>
T ordered_reduce(const Context& context, std::size_t count, std::size_t grain, T identity, Map&& map,
                 Combine&& combine) {
  std::vector<T> partial(block_count(count, grain), identity);
  parallel_for(context, count, grain,
               [&](std::size_t begin, std::size_t end) { partial[begin / grain] = map(begin, end); });
  T total = std::move(identity);
  for (T& part : partial) total = combine(std::move(total), std::move(part));
  return total;
}

}  // namespace bodice::engine
