// Limbs that are parted by the necks between them, on shapes with known necks.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "walls/limb_follow.hpp"
#include "walls/limb_kind.hpp"
#include "walls/limb_walls.hpp"

using namespace bodice;
using geometry::Vec3;

namespace {

/// Depths of a body of upright cylinders on a grid of 1 cm cells, 170 of them high.
struct Cylinder {
  double x, radius;
  int from, to;
};

geometry::FieldGrid grid_of(const std::vector<Cylinder>& cylinders) {
  geometry::FieldGrid grid;
  grid.cell_m = 0.01;
  grid.nodes = {80, 174, 64};
  grid.value.assign(grid.nodes[0] * grid.nodes[1] * grid.nodes[2], -1.0F);
  for (std::size_t z = 0; z < grid.nodes[2]; ++z)
    for (std::size_t y = 0; y < grid.nodes[1]; ++y)
      for (std::size_t x = 0; x < grid.nodes[0]; ++x)
        for (const Cylinder& c : cylinders) {
          if (static_cast<int>(y) < c.from || static_cast<int>(y) > c.to) continue;
          const double from_axis =
              std::hypot(static_cast<double>(x) - 40.0 - c.x, static_cast<double>(z) - 20.0);
          float& value = grid.value[grid.index(x, y, z)];
          value = std::max(value, static_cast<float>(0.01 * (c.radius - from_axis)));
        }
  return grid;
}

/// A straight limb from one node to another, with a round cross-section.
struct Limb {
  Vec3 from, to;
  double radius;
};

void add(const Limb& limb, geometry::FieldGrid& grid) {
  const Vec3 along = limb.to - limb.from;
  for (std::size_t z = 0; z < grid.nodes[2]; ++z)
    for (std::size_t y = 0; y < grid.nodes[1]; ++y)
      for (std::size_t x = 0; x < grid.nodes[0]; ++x) {
        const Vec3 offset =
            Vec3(static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)) - limb.from;
        const double share = std::clamp(offset.dot(along) / along.squaredNorm(), 0.0, 1.0);
        float& value = grid.value[grid.index(x, y, z)];
        value = std::max(value, static_cast<float>(0.01 * (limb.radius - (offset - share * along).norm())));
      }
}

struct At {
  int x, y, z = 20;
};

/// Whether a path inside leads from one node to another without crossing a wall, within the slices given.
bool joined(const geometry::FieldGrid& grid, const std::vector<char>& wall, const At& from, const At& to,
            int low, int high) {
  std::vector<char> seen(grid.value.size());
  const auto open = [&](std::size_t x, std::size_t y, std::size_t z) {
    const std::size_t at = grid.index(x, y, z);
    return grid.value[at] > 0.0F && (wall.empty() || !wall[at]) && !seen[at];
  };
  struct Node {
    std::size_t x, y, z;
  };
  const auto node = [](const At& at) {
    return Node{static_cast<std::size_t>(at.x), static_cast<std::size_t>(at.y),
                static_cast<std::size_t>(at.z)};
  };
  std::vector<Node> stack{node(from)};
  while (!stack.empty()) {
    const Node n = stack.back();
    stack.pop_back();
    if (static_cast<int>(n.y) < low || static_cast<int>(n.y) > high || !open(n.x, n.y, n.z)) continue;
    seen[grid.index(n.x, n.y, n.z)] = 1;
    for (const Node& next : {Node{n.x + 1, n.y, n.z}, Node{n.x - 1, n.y, n.z}, Node{n.x, n.y + 1, n.z},
                             Node{n.x, n.y - 1, n.z}, Node{n.x, n.y, n.z + 1}, Node{n.x, n.y, n.z - 1}})
      stack.push_back(next);
  }
  const Node end = node(to);
  return seen[grid.index(end.x, end.y, end.z)] != 0;
}

/// Two legs, a trunk above them from a height of 80 on, with shoulders, and arms of a radius of 4 that
/// overlap it by 1.
std::vector<Cylinder> limbs_and_trunk() {
  return {{-8.0, 8.5, 3, 80},    {8.0, 8.5, 3, 80},     {0.0, 16.0, 78, 168}, {-16.0, 8.0, 124, 140},
          {16.0, 8.0, 124, 140}, {-19.0, 4.0, 65, 125}, {19.0, 4.0, 65, 125}};
}

}  // namespace

TEST_CASE("a wall parts two thighs that overlap, up to the trunk and no further") {
  const geometry::FieldGrid grid = grid_of(limbs_and_trunk());
  const std::vector<char> wall = anatomy::limb_walls(grid, 0.92);
  REQUIRE(wall.size() == grid.value.size());
  CHECK(joined(grid, {}, {32, 40}, {48, 40}, 0, 70));
  CHECK(!joined(grid, wall, {32, 40}, {48, 40}, 0, 70));
  CHECK(joined(grid, wall, {32, 40}, {48, 40}, 0, 173));
}

TEST_CASE("a wall parts arms from the trunk that they overlap, and leaves them at the shoulder") {
  const geometry::FieldGrid grid = grid_of(limbs_and_trunk());
  const std::vector<char> wall = anatomy::limb_walls(grid, 0.92);
  for (const int x : {21, 59}) {
    CAPTURE(x);
    CHECK(joined(grid, {}, {x, 90}, {40, 90}, 60, 115));
    CHECK(!joined(grid, wall, {x, 90}, {40, 90}, 60, 115));
    CHECK(joined(grid, wall, {x, 90}, {40, 90}, 60, 173));
  }
}

TEST_CASE("a trunk without limbs gets no wall") {
  const geometry::FieldGrid grid = grid_of({{0.0, 16.0, 3, 168}});
  const std::vector<char> wall = anatomy::limb_walls(grid, 0.92);
  CHECK(std::none_of(wall.begin(), wall.end(), [](char w) { return w != 0; }));
}

TEST_CASE("an upper arm that is sunk into the trunk is parted from it, and keeps its forearm and hand") {
  geometry::FieldGrid grid = grid_of({{-8.0, 8.5, 3, 80},
                                      {8.0, 8.5, 3, 80},
                                      {-4.0, 14.0, 78, 168},
                                      {0.0, 15.0, 78, 168},
                                      {4.0, 14.0, 78, 168}});
  for (const double side : {-1.0, 1.0}) {
    const double x = 40.0 + side * 14.0;
    add({{x, 108.0, 20.0}, {x, 138.0, 20.0}, 5.0}, grid);
    add({{x, 108.0, 20.0}, {x, 99.0, 44.0}, 4.0}, grid);  // the forearm points forward
    add({{x, 94.0, 49.0}, {x, 99.0, 49.0}, 3.0}, grid);   // the hand hangs from it
  }
  const anatomy::Slices slices(grid);
  anatomy::LimbTracks limbs = anatomy::limb_tracks(slices, 0.92, 363.0);
  anatomy::follow_limbs(slices, limbs);
  CHECK(std::ranges::count_if(limbs.tracks, [&](const auto& t) { return anatomy::is_arm(slices, t); }) == 2);
  const std::vector<char> wall = anatomy::limb_walls(grid, 0.92);
  for (const int side : {-1, 1}) {
    CAPTURE(side);
    const int x = 40 + side * 14;
    const At arm{x + 3 * side, 120}, trunk{40, 120};
    CHECK(joined(grid, {}, arm, trunk, 90, 128));
    CHECK(!joined(grid, wall, arm, trunk, 0, 128));
    CHECK(joined(grid, wall, arm, trunk, 0, 173));
    CHECK(joined(grid, wall, arm, {x, 104, 32}, 85, 128));
    CHECK(joined(grid, wall, arm, {x, 94, 49}, 85, 128));
  }
}
