#include "base/schedule.hpp"

#include <algorithm>

#include <bodice/cloth/coloring.hpp>

namespace bodice::inline v0_1::cloth {
namespace {

using geometry::Index;

constexpr std::size_t kSmallestBlock =
    256;                               // in smaller blocks, more constraints lie across blocks than inside
constexpr std::size_t kFewBlocks = 8;  // enough blocks for a few workers to share evenly

// The constraints to schedule.
struct Wanted {
  std::span<const Index> members;
  std::size_t arity, particle_count;

  std::span<const Index> of(std::size_t constraint) const {
    return members.subspan(constraint * arity, arity);
  }
};

// Appends packs of the listed constraints, color by color; returns the first pack of each color.
std::vector<std::uint32_t> append(const Wanted& wanted, const std::vector<std::uint32_t>& listed, Index idle,
                                  Schedule& out) {
  std::vector<Index> members;
  for (const std::uint32_t c : listed)
    members.insert(members.end(), wanted.of(c).begin(), wanted.of(c).end());
  const Coloring coloring = color(members, wanted.arity, wanted.particle_count);
  std::vector<std::uint32_t> begin(1, static_cast<std::uint32_t>(out.packs()));
  for (std::size_t k = 0; k < coloring.colors(); ++k) {
    for (std::uint32_t i = coloring.begin[k]; i < coloring.begin[k + 1]; ++i)
      out.slot.push_back(listed[coloring.order[i]]);
    out.slot.resize((out.slot.size() + out.pack - 1) / out.pack * out.pack, kIdle);
    out.idle.resize(out.slot.size() / out.pack, idle);
    begin.push_back(static_cast<std::uint32_t>(out.packs()));
  }
  return begin;
}

}  // namespace

std::size_t block_size(std::size_t particles) {
  const std::size_t size = std::clamp(particles / kFewBlocks, kSmallestBlock, kLargestBlock);
  return (size + 3) / 4 * 4;
}

std::size_t idle_particles(std::size_t particles) {
  return engine::block_count(particles, block_size(particles)) + 1;
}

Schedule make_schedule(std::span<const Index> members, std::size_t arity, std::size_t particle_count,
                       std::size_t pack) {
  const Wanted wanted{members, arity, particle_count};
  const std::size_t size = block_size(particle_count), blocks = engine::block_count(particle_count, size);
  std::vector<std::vector<std::uint32_t>> inside(blocks);
  std::vector<std::uint32_t> across;
  for (std::size_t c = 0; c < members.size() / arity; ++c) {
    const auto of = wanted.of(c);
    const std::size_t block = of[0] / size;
    const bool whole = std::all_of(of.begin(), of.end(), [&](Index p) { return p / size == block; });
    (whole ? inside[block] : across).push_back(static_cast<std::uint32_t>(c));
  }
  Schedule out;
  out.pack = pack;
  out.block_begin.push_back(0);
  for (std::size_t b = 0; b < blocks; ++b) {
    append(wanted, inside[b], static_cast<Index>(particle_count + b), out);
    out.block_begin.push_back(static_cast<std::uint32_t>(out.packs()));
  }
  out.color_begin = append(wanted, across, static_cast<Index>(particle_count + blocks), out);
  return out;
}

}  // namespace bodice::cloth
