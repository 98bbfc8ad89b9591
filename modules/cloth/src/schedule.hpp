// Who is solved when: particles lie in blocks (they are in Morton order, so a block is a patch of cloth).
// Constraints inside a block are one worker's, one after the other, while the patch is in its cache; the few
// across blocks follow by colour. That is two meetings of the workers a sweep in place of one a colour.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <bodice/engine/context.hpp>
#include <bodice/engine/parallel.hpp>
#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::cloth {

inline constexpr std::size_t kPack = 8;  ///< constraints solved together; they share no particle
inline constexpr std::uint32_t kIdle = ~std::uint32_t{0};
/// Packs a task, of those across blocks.
inline constexpr std::size_t kPackGrain = 32;

struct Schedule {
  std::size_t pack = kPack;                ///< slots a pack
  std::vector<std::uint32_t> slot;         ///< a constraint each, or kIdle
  std::vector<geometry::Index> idle;       ///< a pack: the particle that its idle slots may name
  std::vector<std::uint32_t> block_begin;  ///< #blocks + 1, packs
  std::vector<std::uint32_t> color_begin;  ///< #colours + 1, packs across blocks

  std::size_t packs() const { return idle.size(); }
};

/// Particles a block: it depends on their number alone. At least eight blocks where that leaves patches.
std::size_t block_size(std::size_t particles);
/// Idle slots name particles from `particles` on, one a block and one more, so that no two tasks share one.
std::size_t idle_particles(std::size_t particles);

/// `members` holds `arity` particles (< particle_count) a constraint. O(#C arity + #blocks #P).
Schedule make_schedule(std::span<const geometry::Index> members, std::size_t arity,
                       std::size_t particle_count, std::size_t pack = kPack);

/// Calls solve(begin, end) for the packs across blocks, colour by colour.
template <class Solve>
void for_each_across(const engine::Context& context, const Schedule& schedule, Solve&& solve) {
  for (std::size_t c = 0; c + 1 < schedule.color_begin.size(); ++c) {
    const std::size_t first = schedule.color_begin[c];
    engine::parallel_for(context, schedule.color_begin[c + 1] - first, kPackGrain,
                         [&](std::size_t begin, std::size_t end) { solve(first + begin, first + end); });
  }
}

}  // namespace bodice::cloth
