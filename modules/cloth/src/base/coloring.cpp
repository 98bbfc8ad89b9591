#include <bit>

#include <bodice/cloth/coloring.hpp>

namespace bodice::inline v0_1::cloth {
namespace {

constexpr std::uint32_t kUncolored = ~std::uint32_t{0};
constexpr std::uint32_t kColorsAPass = 64;  // a machine word holds the used colors of a particle

// Colors the constraints that fit into 64 more colors. Returns how many are left for the next pass.
std::size_t color_pass(std::span<const geometry::Index> particles, std::size_t arity,
                       std::uint32_t first_color, std::vector<std::uint64_t>& used,
                       std::vector<std::uint32_t>& color_of) {
  std::fill(used.begin(), used.end(), 0);
  std::size_t left = 0;
  for (std::size_t c = 0; c < color_of.size(); ++c) {
    if (color_of[c] != kUncolored) continue;
    const auto members = particles.subspan(c * arity, arity);
    std::uint64_t taken = 0;
    for (const geometry::Index p : members) taken |= used[p];
    const auto free = static_cast<std::uint32_t>(std::countr_one(taken));
    if (free == kColorsAPass) {
      ++left;
      continue;
    }
    color_of[c] = first_color + free;
    for (const geometry::Index p : members) used[p] |= std::uint64_t{1} << free;
  }
  return left;
}

}  // namespace

Coloring color(std::span<const geometry::Index> particles, std::size_t arity, std::size_t particle_count) {
  const std::size_t count = arity == 0 ? 0 : particles.size() / arity;
  std::vector<std::uint32_t> color_of(count, kUncolored);
  std::vector<std::uint64_t> used(particle_count);
  for (std::uint32_t first = 0; color_pass(particles, arity, first, used, color_of) > 0;)
    first += kColorsAPass;

  Coloring out;
  for (const std::uint32_t c : color_of) {
    if (c + 2 > out.begin.size()) out.begin.resize(c + 2, 0);
    ++out.begin[c + 1];
  }
  for (std::size_t c = 1; c < out.begin.size(); ++c) out.begin[c] += out.begin[c - 1];
  std::vector<std::uint32_t> next = out.begin;
  out.order.resize(count);
  for (std::size_t c = 0; c < count; ++c) out.order[next[color_of[c]]++] = static_cast<std::uint32_t>(c);
  return out;
}

}  // namespace bodice::cloth
