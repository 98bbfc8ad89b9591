#include "pose/followed_table.hpp"

#include <algorithm>
#include <cmath>

#include "pose/lanes.hpp"
#include "pose/vector_clones.hpp"
#include "tolerances.hpp"

namespace bodice::binding {
namespace {

using geometry::Float4;

constexpr int kFixedPointSteps = 2;

/// Directions of consecutive texels of a table of n x n, in the rest table's frame.
BODICE_CLONES
void directions(int first, int n, const float* to_table, Lanes (&u)[3]) {
  const float step = 2.0f / static_cast<float>(n - 1);
  const float inverse = 1.0f / static_cast<float>(n);
  for (int l = 0; l < kLanes; ++l) {
    const int texel = first + l;
    // Exact for any texel of a table: a half is far from the rounding of a quotient of small numbers.
    const int row = static_cast<int>((static_cast<float>(texel) + 0.5f) * inverse);
    const float x = static_cast<float>(texel - row * n) * step - 1.0f;
    const float y = static_cast<float>(row) * step - 1.0f;
    const float z = 1.0f - std::abs(x) - std::abs(y);
    const float fold = std::max(-z, 0.0f);
    const float px = x - std::copysign(fold, x), py = y - std::copysign(fold, y);
    const float scale = 1.0f / std::sqrt(px * px + py * py + z * z);
    for (int i = 0; i < 3; ++i)
      u[i][l] = (to_table[3 * i] * px + to_table[3 * i + 1] * py + to_table[3 * i + 2] * z) * scale;
  }
}

/// Nodes and bilinear weights around directions of any length but zero.
BODICE_CLONES
void stencils(const Lanes (&u)[3], int n, std::int32_t (&first)[kLanes], Lanes (&weight)[4]) {
  const float half = 0.5f * static_cast<float>(n - 1);
  const auto last = static_cast<float>(n - 2);
  for (int l = 0; l < kLanes; ++l) {
    const float ax = std::abs(u[0][l]), ay = std::abs(u[1][l]);
    const float scale = 1.0f / std::max(ax + ay + std::abs(u[2][l]), 1e-20f);
    float x = u[0][l] * scale, y = u[1][l] * scale;
    const float fx = std::copysign(1.0f - ay * scale, u[0][l]);
    const float fy = std::copysign(1.0f - ax * scale, u[1][l]);
    x = u[2][l] < 0.0f ? fx : x;
    y = u[2][l] < 0.0f ? fy : y;
    // In this order of arguments, what is not a number becomes 0.
    const float gx = std::max(0.0f, (x + 1.0f) * half), gy = std::max(0.0f, (y + 1.0f) * half);
    const auto i = static_cast<std::int32_t>(std::min(gx, last));
    const auto j = static_cast<std::int32_t>(std::min(gy, last));
    const float s = std::min(gx - static_cast<float>(i), 1.0f);
    const float t = std::min(gy - static_cast<float>(j), 1.0f);
    first[l] = j * n + i;
    weight[0][l] = (1.0f - s) * (1.0f - t);
    weight[1][l] = s * (1.0f - t);
    weight[2][l] = (1.0f - s) * t;
    weight[3][l] = s * t;
  }
}

struct Stencils {
  std::int32_t first[kLanes];
  Lanes weight[4];

  Float4 read(const Float4* values, int n, int lane) const {
    const Float4* const at = values + first[lane];
    return weight[0][lane] * at[0] + weight[1][lane] * at[1] + weight[2][lane] * at[n] +
           weight[3][lane] * at[n + 1];
  }
};

/// The texels [first, first + kLanes) of the posed table, as floats.
void resample(int first, int n, const float* to_table, float scale, float inverse_out, TableScratch& scratch,
              std::uint8_t* burial) {
  Lanes target[3], u[3];
  directions(first, n, to_table, target);
  for (int i = 0; i < 3; ++i) std::copy(target[i], target[i] + kLanes, u[i]);
  Stencils at;
  for (int step = 0; step < kFixedPointSteps; ++step) {
    stencils(u, n, at.first, at.weight);
    for (int l = 0; l < kLanes; ++l) {
      const Float4 change = at.read(scratch.changes.data(), n, l);
      for (int i = 0; i < 3; ++i) u[i][l] = target[i][l] - change[i];
    }
  }
  stencils(u, n, at.first, at.weight);
  const int count = std::min(kLanes, n * n - first);
  for (int l = 0; l < count; ++l) {
    const Float4 rest = at.read(scratch.rest.data(), n, l);
    const float slope = std::max(static_cast<float>(kLeastSlope), 1.0f - rest[1] * inverse_out);
    scratch.h[static_cast<std::size_t>(first + l)] = scale * rest[0] + rest[3] * slope;
    scratch.a[static_cast<std::size_t>(first + l)] = scale * rest[1];
    burial[first + l] = static_cast<std::uint8_t>(rest[2] + 0.5f);
  }
}

/// The texels at rest as floats, mixed with those of base poses.
void read_values(const RestTable& rest, int count, TableScratch& scratch) {
  for (int i = 0; i < count; ++i)
    scratch.rest[static_cast<std::size_t>(i)] = Float4{0.0f, 0.0f, static_cast<float>(rest.burial[i]), 0.0f};
  for (const TableShare& from : rest.values) {
    const proxy::ReliefTable& table = *from.table;
    const float h_step = from.share * table.h_scale_m / 255.0f, a_step = from.share * table.a_scale / 255.0f;
    const float h_first = from.share * table.h_offset_m, a_first = from.share * table.a_offset;
    for (int i = 0; i < count; ++i) {
      const proxy::ReliefTexel texel = from.texels[i];
      scratch.rest[static_cast<std::size_t>(i)] +=
          Float4{h_first + h_step * texel.h, a_first + a_step * texel.a, 0.0f, 0.0f};
    }
  }
}

/// A range of values and how bytes divide it.
struct ByteRange {
  float low = 0.0f, size = 0.0f;
};

BODICE_CLONES
ByteRange bounded(float* values, int count, float most) {
  float low = values[0], high = values[0];
  for (int i = 0; i < count; ++i) {
    values[i] = std::min(std::max(values[i], -most), most);
    low = std::min(low, values[i]);
    high = std::max(high, values[i]);
  }
  return {low, high - low};
}

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

void follow(const RestTable& rest, const CarriedEllipsoid& carried, const TableReach& reach,
            TableScratch& scratch, proxy::ReliefTable& table, proxy::ReliefTexel* texels,
            std::uint8_t* burial) {
  const int n = rest.table.nodes_per_side, count = n * n;
  read_values(rest, count, scratch);
  for (int i = 0; i < count; ++i) {
    const Change& change = scratch.changes[static_cast<std::size_t>(rest.followers[i])];
    scratch.changes[static_cast<std::size_t>(i)] = change;
    scratch.rest[static_cast<std::size_t>(i)][3] = change[3];  // growth is read together with the values
  }
  float to_table[9];
  for (int i = 0; i < 9; ++i) to_table[i] = static_cast<float>(carried.to_table(i / 3, i % 3));
  const auto scale = static_cast<float>(carried.scale);
  for (int first = 0; first < count; first += kLanes)
    resample(first, n, to_table, scale, static_cast<float>(1.0 / reach.out_m), scratch, burial);
  const auto most = static_cast<float>(kHighest * reach.out_m * carried.scale);
  const ByteRange h = bounded(scratch.h.data(), count, most);
  const ByteRange a = bounded(scratch.a.data(), count, most);
  to_bytes(scratch.h.data(), h, scratch.a.data(), a, count, texels);
  table.h_offset_m = h.low;
  table.h_scale_m = h.size;
  table.a_offset = a.low;
  table.a_scale = a.size;
}

}  // namespace bodice::binding
