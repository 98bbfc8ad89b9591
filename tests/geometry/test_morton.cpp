#include <doctest/doctest.h>

#include <bodice/engine/random.hpp>
#include <bodice/geometry/detail/morton.hpp>

using namespace bodice::geometry;

TEST_CASE("a Morton code holds bit i of x, y, z at bits 3 i, 3 i + 1, 3 i + 2") {
  bodice::engine::Random random(1);
  for (int repeat = 0; repeat < 1000; ++repeat) {
    std::uint32_t cell[3], expected = 0;
    for (int axis = 0; axis < 3; ++axis) {
      cell[axis] = static_cast<std::uint32_t>(random.uniform(0.0, 1 << kMortonBits));
      for (int bit = 0; bit < kMortonBits; ++bit) expected |= (cell[axis] >> bit & 1u) << (3 * bit + axis);
    }
    REQUIRE(morton_code(cell[0], cell[1], cell[2]) == expected);
  }
}
