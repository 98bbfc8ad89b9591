// Who is solved when: particles lie in blocks (they are in Morton order, so a block is a patch of cloth).
// Constraints inside a block are one worker's, one after the other, while the patch is in its cache; the few
// across blocks follow by color. That is two meetings of the workers a sweep in place of one a color.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include <bodice/engine/context.hpp>
#include <bodice/engine/parallel.hpp>
#include <bodice/geometry/tri_mesh.hpp>

#include "base/float4.hpp"

namespace bodice::cloth {

inline constexpr std::size_t kPack = 8;  ///< constraints solved together; they share no particle
inline constexpr std::uint32_t kIdle = ~std::uint32_t{0};
/// Packs a task, of those across blocks.
inline constexpr std::size_t kPackGrain = 32;
/// Particles a block; its points, 16 bytes each, and what it is solved with fit into a core's second cache.
inline constexpr std::size_t kLargestBlock = 1024;

/// A particle by its place in a block.
using Local = std::uint16_t;
static_assert(kLargestBlock <= 0xFFFF);

/// A block's points while its worker solves them; the one behind the last is what idle slots name.
struct Patch {
  Point at[kLargestBlock + 1];
};

struct Schedule {
  std::size_t pack = kPack;                ///< slots a pack
  std::vector<std::uint32_t> slot;         ///< a constraint each, or kIdle
  std::vector<geometry::Index> idle;       ///< a pack: the particle that its idle slots may name
  std::vector<std::uint32_t> block_begin;  ///< #blocks + 1, packs
  std::vector<std::uint32_t> color_begin;  ///< #colors + 1, packs across blocks

  std::size_t packs() const { return idle.size(); }
  std::size_t blocks() const { return block_begin.size() - 1; }
  std::size_t packs_inside() const { return block_begin.back(); }
  /// Of `inside`, the packs inside a block.
  template <class Pack>
  std::span<Pack> inside(std::span<Pack> inside, std::size_t block) const {
    return inside.subspan(block_begin[block], block_begin[block + 1] - block_begin[block]);
  }
  /// Of `across`, the packs across blocks, those numbered [begin, end) among all.
  template <class Pack>
  std::span<Pack> across(std::span<Pack> across, std::size_t begin, std::size_t end) const {
    return across.subspan(begin - packs_inside(), end - begin);
  }
};

/// Particles a block: it depends on their number alone. At least eight blocks where that leaves patches.
std::size_t block_size(std::size_t particles);
/// Idle slots name particles from `particles` on, one a block and one more, so that no two tasks share one.
std::size_t idle_particles(std::size_t particles);

/// `members` holds `arity` particles (< particle_count) a constraint. O(#C arity + #blocks #P).
Schedule make_schedule(std::span<const geometry::Index> members, std::size_t arity,
                       std::size_t particle_count, std::size_t pack = kPack);

/// Calls fill(pack, place in it, constraint or kIdle, first, idle) for every slot; what it names is counted
/// from `first` on, the block's first particle (0 across blocks), and an idle slot names `idle`.
template <class Fill>
void for_each_slot(const Schedule& schedule, std::size_t particle_count, Fill&& fill) {
  const std::size_t size = block_size(particle_count), pack_size = schedule.pack;
  auto fill_packs = [&](std::size_t begin, std::size_t end, std::size_t first, std::size_t idle) {
    for (std::size_t slot = begin * pack_size; slot < end * pack_size; ++slot)
      fill(slot / pack_size, slot % pack_size, schedule.slot[slot], static_cast<geometry::Index>(first),
           static_cast<geometry::Index>(idle));
  };
  for (std::size_t b = 0; b < schedule.blocks(); ++b)
    fill_packs(schedule.block_begin[b], schedule.block_begin[b + 1], b * size,
               std::min((b + 1) * size, particle_count));
  fill_packs(schedule.packs_inside(), schedule.packs(), 0, particle_count + schedule.blocks());
}

/// Calls solve(begin, end) for the packs across blocks, color by color.
template <class Solve>
void for_each_across(const engine::Context& context, const Schedule& schedule, Solve&& solve) {
  for (std::size_t c = 0; c + 1 < schedule.color_begin.size(); ++c) {
    const std::size_t first = schedule.color_begin[c];
    engine::parallel_for(context, schedule.color_begin[c + 1] - first, kPackGrain,
                         [&](std::size_t begin, std::size_t end) { solve(first + begin, first + end); });
  }
}

}  // namespace bodice::cloth
