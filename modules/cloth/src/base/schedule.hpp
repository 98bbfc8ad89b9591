// The parallel schedule of constraints. Particles form blocks, which are patches of cloth, because particles
// are in Morton order. One worker solves all constraints inside a block, one after the other, while the patch
// is in its cache; the few constraints across blocks follow color by color. A sweep thus synchronizes once
// for all blocks, and then only for the colors across them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include <bodice/engine/context.hpp>
#include <bodice/engine/parallel.hpp>
#include <bodice/geometry/tri_mesh.hpp>

#include "base/float4.hpp"

namespace bodice::inline v0_1::cloth {

inline constexpr std::size_t kPack = 8;  ///< constraints solved together; they share no particle
inline constexpr std::uint32_t kIdle = ~std::uint32_t{0};  ///< a slot without a constraint
inline constexpr std::size_t kPackGrain = 32;              ///< packs a task, for those across blocks
/// The most particles in a block: their points, 16 bytes each, and their constraints fit into a core's
/// second-level cache.
inline constexpr std::size_t kLargestBlock = 1024;

/// The index of a particle within its block.
using Local = std::uint16_t;
static_assert(kLargestBlock <= 0xFFFF);

/// The points of a block while its worker solves them. Idle slots use the point after the last one.
struct Patch {
  Point at[kLargestBlock + 1];
};

/// Constraints in packs: first those inside blocks, block by block, then those across blocks, color by color.
struct Schedule {
  std::size_t pack = kPack;                ///< slots in a pack
  std::vector<std::uint32_t> slot;         ///< the constraint of each slot, or kIdle
  std::vector<geometry::Index> idle;       ///< #packs: the particle that the pack's idle slots use
  std::vector<std::uint32_t> block_begin;  ///< #blocks + 1: the first pack of each block
  std::vector<std::uint32_t> color_begin;  ///< #colors + 1: the first pack of each color across blocks

  std::size_t packs() const { return idle.size(); }
  std::size_t blocks() const { return block_begin.size() - 1; }
  std::size_t packs_inside() const { return block_begin.back(); }
  /// The packs inside a block, out of `inside`.
  template <class Pack>
  std::span<Pack> inside(std::span<Pack> inside, std::size_t block) const {
    return inside.subspan(block_begin[block], block_begin[block + 1] - block_begin[block]);
  }
  /// The packs with numbers [begin, end), out of those across blocks.
  template <class Pack>
  std::span<Pack> across(std::span<Pack> across, std::size_t begin, std::size_t end) const {
    return across.subspan(begin - packs_inside(), end - begin);
  }
};

/// The number of particles in a block, which depends on the number of particles alone. There are at least
/// eight blocks, unless these would be too small.
std::size_t block_size(std::size_t particles);
/// The number of additional points that idle slots use: one for each block and one more, so that no two tasks
/// share one.
std::size_t idle_particles(std::size_t particles);

/// Makes the schedule of constraints. `members` holds `arity` particles (< particle_count) for each
/// constraint. Cost: O(#C arity + #blocks #P).
Schedule make_schedule(std::span<const geometry::Index> members, std::size_t arity,
                       std::size_t particle_count, std::size_t pack = kPack);

/// Calls fill(pack, lane, constraint or kIdle, first, idle) for every slot. Particles of the pack are stored
/// relative to `first`, the block's first particle (0 across blocks); an idle slot uses the particle `idle`.
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

/// Calls solve(begin, end) for ranges of packs across blocks, color by color.
template <class Solve>
void for_each_across(const engine::Context& context, const Schedule& schedule, Solve&& solve) {
  for (std::size_t c = 0; c + 1 < schedule.color_begin.size(); ++c) {
    const std::size_t first = schedule.color_begin[c];
    engine::parallel_for(context, schedule.color_begin[c + 1] - first, kPackGrain,
                         [&](std::size_t begin, std::size_t end) { solve(first + begin, first + end); });
  }
}

}  // namespace bodice::cloth
