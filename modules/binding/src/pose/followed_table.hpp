// A table that follows the skin: resampled where its skin points went, and read in the pose's directions.
#pragma once

#include <span>
#include <vector>

#include <bodice/proxy/posed_proxy.hpp>

#include "pose/skin_changes.hpp"

namespace bodice::inline v0_1::binding {

/// The values of a table in a base pose, and how much they count.
struct TableShare {
  const proxy::ReliefTable* table = nullptr;
  const proxy::ReliefTexel* texels = nullptr;
  float share = 0.0f;
};

/// Shifts are found at the directions of a table of so many nodes a side, half as fine as one of `nodes`.
constexpr int shift_nodes(int nodes) {
  return nodes / 2 + 1;
}

/// What a table needs while it is posed: floats for as many texels as the largest table has.
struct TableScratch {
  std::vector<TableShare> values;
  std::vector<Change> changes;
  std::vector<geometry::Float4> rest;             ///< h, a, growth, meters; nothing
  std::vector<float> h, a;                        ///< the pose's table, meters
  std::vector<std::uint8_t> burial;               ///< in bytes
  std::vector<geometry::Float4> coarse;           ///< shifts of the coarser table
  std::array<std::vector<float>, 3> wide, shift;  ///< shifts of its rows with all columns, and of all texels

  /// Makes room for tables of up to so many nodes a side.
  void reserve(int nodes);
};

/// One table at rest.
struct RestTable {
  const proxy::ReliefTable& table;
  std::span<const TableShare> values;  ///< its own and those of base poses; shares sum to 1
  const std::uint8_t* burial;
  const std::uint16_t* followers;  ///< the skin node that each texel changes with
};

/// The same table in a pose, to be written: as many texels as at rest.
struct FollowedTable {
  proxy::ReliefTable& table;  ///< its scales
  proxy::ReliefTexel* texels;
  std::uint8_t* burial;
};

/// The lengths that heights and burial are measured by.
struct TableReach {
  double out_m = 0.0;          ///< how far relief reaches outward at rest
  double burial_step_m = 0.0;  ///< unit of burial in the pose
};

/// Writes texels, burial and scales of the posed table, given the changes of its nodes in scratch.changes.
/// For texel direction w: u = V w - shift(w); h = s h(u) + growth(u) (1 - a(u) / out) and a = s a(u), with s
/// the ellipsoid's scale. The shift is bilinear between directions of a table of shift_nodes(n) a side, at
/// which shift(w) = change(V w - change(V w)). Burial is that of the texel nearest to u, and more where
/// growth(u) is large (yield.hpp). Allocates nothing.
void follow(const RestTable& rest, const CarriedEllipsoid& carried, const TableReach& reach,
            TableScratch& scratch, const FollowedTable& posed);

}  // namespace bodice::binding
