#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include <bodice/engine/parallel.hpp>
#include <bodice/geometry/contour.hpp>

namespace bodice::inline v0_1::geometry {
namespace {

/// Nodes along each side of the largest and the smallest blocks that one value may decide.
constexpr std::size_t kBlock = 8, kLeastBlock = 2;
/// Where no triangle is near, a winding number this far from one half is on the same side all around.
constexpr double kClearWinding = 0.4;

using Node = std::array<std::size_t, 3>;

FieldGrid make_grid(const Box& box, double cell_m) {
  FieldGrid grid;
  grid.cell_m = cell_m;
  grid.low = box.low - Vec3::Constant(2.0 * cell_m);
  for (int k = 0; k < 3; ++k)
    grid.nodes[static_cast<std::size_t>(k)] = static_cast<std::size_t>(std::ceil(box.size()[k] / cell_m)) + 5;
  return grid;
}

/// A block of nodes with `side` of them along each side, its middle, and more than the distance from there to
/// any of its nodes or their neighbors: with a surface farther away, none of them lies across it.
struct NodeBlock {
  Node first;
  std::size_t side;
  Vec3 middle;
  double radius;
};

/// Samples `field` block by block, nodes being blocks of one. `decided` gives one value for all of a block,
/// or 0 where its nodes differ.
template <class Field, class Decided>
class Sampler {
 public:
  Sampler(FieldGrid& grid, const Field& field, const Decided& decided)
      : grid_(grid), field_(field), decided_(decided) {}

  /// Sets the nodes of a block with `side` nodes along each side. One that is not decided is cut into eight.
  void fill(const Node& first, std::size_t side) {
    for (std::size_t k = 0; k < 3; ++k)
      if (first[k] >= grid_.nodes[k]) return;
    const double for_all = decided_(block(first, side));
    if (for_all == 0.0 && side > kLeastBlock) {
      for (std::size_t eighth = 0; eighth < 8; ++eighth)
        fill({first[0] + (eighth & 1) * side / 2, first[1] + (eighth >> 1 & 1) * side / 2,
              first[2] + (eighth >> 2) * side / 2},
             side / 2);
      return;
    }
    for (std::size_t z = first[2]; z < std::min(first[2] + side, grid_.nodes[2]); ++z)
      for (std::size_t y = first[1]; y < std::min(first[1] + side, grid_.nodes[1]); ++y)
        for (std::size_t x = first[0]; x < std::min(first[0] + side, grid_.nodes[0]); ++x)
          grid_.value[grid_.index(x, y, z)] =
              static_cast<float>(for_all != 0.0 ? for_all : field_(block({x, y, z}, 1)));
  }

 private:
  NodeBlock block(const Node& first, std::size_t side) const {
    const double half = 0.5 * static_cast<double>(side - 1);
    const Vec3 node(static_cast<double>(first[0]), static_cast<double>(first[1]),
                    static_cast<double>(first[2]));
    return {first, side, grid_.low + grid_.cell_m * (node + Vec3::Constant(half)),
            grid_.cell_m * (half * std::sqrt(3.0) + 2.0)};
  }

  FieldGrid& grid_;
  const Field& field_;
  const Decided& decided_;
};

template <class Field, class Decided>
FieldGrid sample(const engine::Context& context, FieldGrid grid, const Field& field, const Decided& decided) {
  grid.value.resize(grid.nodes[0] * grid.nodes[1] * grid.nodes[2]);
  Sampler sampler(grid, field, decided);
  Node blocks;
  for (std::size_t k = 0; k < 3; ++k) blocks[k] = engine::block_count(grid.nodes[k], kBlock);
  engine::parallel_for(context, blocks[0] * blocks[1] * blocks[2], 1, [&](std::size_t block, std::size_t) {
    sampler.fill({block % blocks[0] * kBlock, block / blocks[0] % blocks[1] * kBlock,
                  block / blocks[0] / blocks[1] * kBlock},
                 kBlock);
  });
  return grid;
}

/// Samples a field. Where its value at the middle of a block is larger than the radius, it decides the block.
template <class Field>
FieldGrid sample_far(const engine::Context& context, FieldGrid grid, const Field& field) {
  return sample(context, std::move(grid), field, [&](const NodeBlock& block) {
    const double value = field(block);
    return std::abs(value) > block.radius ? value : 0.0;
  });
}

}  // namespace

FieldGrid sample_field(const engine::Context& context, const DistanceField& field, const Box& box,
                       double cell_m) {
  return sample_far(context, make_grid(box, cell_m),
                    [&](const NodeBlock& block) { return field(block.middle); });
}

NodeDistances::NodeDistances(DistanceField distance, const Box& box, double cell_m)
    : distance_(std::move(distance)), empty_(make_grid(box, cell_m)) {
  static_assert(1u << (kSides - 1) == kBlock);
  for (std::size_t level = 0; level < kSides; ++level) {
    std::size_t count = 1;
    for (const std::size_t n : empty_.nodes) count *= engine::block_count(n, std::size_t{1} << level);
    distance_m_[level].assign(count, std::numeric_limits<double>::quiet_NaN());
  }
}

double NodeDistances::known(const Vec3& p, const std::array<std::size_t, 3>& first, std::size_t level) {
  std::size_t at = 0;
  for (const std::size_t k : {2u, 1u, 0u})
    at = at * engine::block_count(empty_.nodes[k], std::size_t{1} << level) + (first[k] >> level);
  double& distance_m = distance_m_[level][at];
  if (std::isnan(distance_m)) distance_m = distance_(p);
  return distance_m;
}

FieldGrid NodeDistances::sample(const engine::Context& context, const Change& change) {
  return sample_far(context, empty_, [&](const NodeBlock& block) {
    const auto level = static_cast<std::size_t>(std::countr_zero(block.side));
    return change(known(block.middle, block.first, level), block.middle);
  });
}

FieldGrid sample_inside(const engine::Context& context, const MeshDistance& surface, const Box& box,
                        double cell_m) {
  const auto field = [&](const NodeBlock& node) { return surface.signed_distance(node.middle); };
  return sample(context, make_grid(box, cell_m), field, [&](const NodeBlock& block) {
    if (surface.closest_point_within(block.middle, block.radius)) return 0.0;
    const double winding = surface.winding_number(block.middle);
    return std::abs(winding - 0.5) > kClearWinding ? (winding > 0.5 ? -block.radius : block.radius) : 0.0;
  });
}

}  // namespace bodice::geometry
