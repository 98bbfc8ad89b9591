#include <doctest/doctest.h>

#include <set>

#include <bodice/cloth/coloring.hpp>
#include <bodice/engine/random.hpp>

using namespace bodice;

namespace {

void check_coloring(const std::vector<geometry::Index>& particles, std::size_t arity, std::size_t count) {
  const cloth::Coloring coloring = cloth::color(particles, arity, count);
  std::set<std::uint32_t> seen;
  for (std::size_t c = 0; c < coloring.colors(); ++c) {
    std::set<geometry::Index> busy;
    for (std::uint32_t k = coloring.begin[c]; k < coloring.begin[c + 1]; ++k) {
      seen.insert(coloring.order[k]);
      for (std::size_t q = 0; q < arity; ++q) {
        REQUIRE(busy.insert(particles[coloring.order[k] * arity + q]).second);
      }
    }
  }
  CHECK(seen.size() == particles.size() / arity);
}

}  // namespace

TEST_CASE("coloring: no two constraints of a color share a particle, and every constraint has a color") {
  const engine::Random random(7);
  for (const std::size_t arity : {2u, 4u}) {
    std::vector<geometry::Index> particles;
    for (std::uint64_t k = 0; k < 3000; ++k) {
      // The members are distinct: steps from a random start never wrap around to it.
      const auto first = static_cast<geometry::Index>(random.bits_at(k) % 400);
      for (geometry::Index q = 0; q < arity; ++q) particles.push_back((first + 37 * q) % 400);
    }
    check_coloring(particles, arity, 400);
  }
}

TEST_CASE("coloring: 200 constraints of one particle take 200 colors, more than a machine word has bits") {
  std::vector<geometry::Index> particles;
  for (geometry::Index k = 1; k <= 200; ++k) particles.insert(particles.end(), {0, k});
  check_coloring(particles, 2, 201);
  CHECK(cloth::color(particles, 2, 201).colors() == 200);
}

TEST_CASE("coloring: an empty list of constraints has no color") {
  CHECK(cloth::color({}, 2, 10).colors() == 0);
}
