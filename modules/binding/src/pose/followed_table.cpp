#include "pose/followed_table.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "pose/lanes.hpp"
#include "pose/resampling.hpp"
#include "pose/vector_clones.hpp"
#include "tolerances.hpp"

namespace bodice::inline v0_1::binding {
namespace {

using geometry::Float4;

/// Adds a share of a table's heights and slopes to those in scratch.h and scratch.a.
BODICE_CLONES
void add_values(const TableShare& from, int count, TableScratch& scratch) {
  const proxy::ReliefTable& table = *from.table;
  const float h_step = from.share * table.h_scale_m / 255.0f, a_step = from.share * table.a_scale / 255.0f;
  const float h_first = from.share * table.h_offset_m, a_first = from.share * table.a_offset;
  const proxy::ReliefTexel* const texels = from.texels;
  float* const h = scratch.h.data();
  float* const a = scratch.a.data();
  for (int i = 0; i < count; ++i) {
    h[i] += h_first + h_step * static_cast<float>(texels[i].h);
    a[i] += a_first + a_step * static_cast<float>(texels[i].a);
  }
}

/// Collects what is read of each texel: its values at rest, and the change of the node that it follows.
BODICE_CLONES
void collect(const RestTable& rest, int count, TableScratch& scratch) {
  std::fill_n(scratch.h.begin(), count, 0.0f);
  std::fill_n(scratch.a.begin(), count, 0.0f);
  for (const TableShare& from : rest.values) add_values(from, count, scratch);
  Change* const changes = scratch.changes.data();
  for (int i = 0; i < count; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const Change change = changes[rest.followers[i]];
    changes[i] = change;
    // Growth is read together with the values.
    scratch.rest[at] = Float4{scratch.h[at], scratch.a[at], change[3], 0.0f};
  }
}

/// A range of values and how bytes divide it.
struct ByteRange {
  float low = 0.0f, size = 0.0f;
};

BODICE_CLONES
void to_bytes(const float* h, const ByteRange& h_range, const float* a, const ByteRange& a_range, int count,
              proxy::ReliefTexel* texels) {
  const float per_h = h_range.size > 0.0f ? 255.0f / h_range.size : 0.0f;
  const float per_a = a_range.size > 0.0f ? 255.0f / a_range.size : 0.0f;
  for (int i = 0; i < count; ++i) {
    texels[i].h = static_cast<std::uint8_t>(static_cast<int>((h[i] - h_range.low) * per_h + 0.5f));
    texels[i].a = static_cast<std::uint8_t>(static_cast<int>((a[i] - a_range.low) * per_a + 0.5f));
  }
}

}  // namespace

void TableScratch::reserve(int nodes) {
  // Chunks end beyond the table.
  const auto n = static_cast<std::size_t>(nodes), m = static_cast<std::size_t>(shift_nodes(nodes));
  const std::size_t padded = n * n + kChunk + proxy::kMostBoundNodes;
  changes.resize(padded);
  rest.resize(padded);
  h.resize(padded);
  a.resize(padded);
  burial.resize(padded);
  coarse.resize(m * m + kChunk);
  for (std::vector<float>& component : wide) component.resize(m * (n + kLanes) + kLanes);
  for (std::vector<float>& component : shift) component.resize(padded);
}

void follow(const RestTable& rest, const CarriedEllipsoid& carried, const TableReach& reach,
            TableScratch& scratch, const FollowedTable& posed) {
  const int n = rest.table.nodes_per_side, count = n * n;
  collect(rest, count, scratch);
  Resampling to;
  to.nodes = n;
  for (int i = 0; i < 9; ++i) to.to_table[i] = static_cast<float>(carried.to_table(i / 3, i % 3));
  to.scale = static_cast<float>(carried.scale);
  to.inverse_out = static_cast<float>(1.0 / reach.out_m);
  to.least_m = static_cast<float>(-kDeepest * reach.out_m * carried.scale);
  to.most_m = static_cast<float>(kHighest * reach.out_m * carried.scale);
  to.yield = yield_rule(reach.out_m, carried.scale);
  if (reach.burial_step_m > 0.0)
    to.per_step = static_cast<float>(1.0 / (proxy::kBurialWeight * reach.burial_step_m));
  find_shifts(to, scratch);
  resample(to, rest.burial, scratch);
  std::copy_n(scratch.burial.begin(), count, posed.burial);
  const ByteRange h{to.h.least(), to.h.most() - to.h.least()}, a{to.a.least(), to.a.most() - to.a.least()};
  to_bytes(scratch.h.data(), h, scratch.a.data(), a, count, posed.texels);
  posed.table.h_offset_m = h.low;
  posed.table.h_scale_m = h.size;
  posed.table.a_offset = a.low;
  posed.table.a_scale = a.size;
}

}  // namespace bodice::binding
