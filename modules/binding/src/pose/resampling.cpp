#include "pose/resampling.hpp"

#include <cmath>
#include <cstring>

#include "pose/vector_clones.hpp"
#include "tolerances.hpp"

namespace bodice::inline v0_1::binding {
namespace {

using geometry::Float4;

/// Nodes and bilinear weights around directions, a direction a lane.
struct Stencils {
  std::int32_t first[kChunk];
  Chunk weight[4];
};

/// Directions of consecutive texels of a table of n x n, in the rest table's frame, and their lengths.
BODICE_LANES void find_directions(int first, int n, const float* to_table, Chunk (&u)[3], Chunk& length) {
  const float step = 2.0f / static_cast<float>(n - 1);
  const float inverse = 1.0f / static_cast<float>(n);
  const int count = n * n;
  for (int l = 0; l < kChunk; ++l) {
    // Lanes beyond the last texel repeat it.
    const int texel = first + l < count ? first + l : count - 1;
    // Exact for any texel of a table: a half is far from the rounding of a quotient of small numbers.
    const int row = static_cast<int>((static_cast<float>(texel) + 0.5f) * inverse);
    const float x = static_cast<float>(texel - row * n) * step - 1.0f;
    const float y = static_cast<float>(row) * step - 1.0f;
    const float z = 1.0f - std::abs(x) - std::abs(y);
    const float fold = greater(-z, 0.0f);
    const float px = x - std::copysign(fold, x), py = y - std::copysign(fold, y);
    length[l] = std::sqrt(px * px + py * py + z * z);
    u[0][l] = to_table[0] * px + to_table[1] * py + to_table[2] * z;
    u[1][l] = to_table[3] * px + to_table[4] * py + to_table[5] * z;
    u[2][l] = to_table[6] * px + to_table[7] * py + to_table[8] * z;
  }
}

/// Nodes and bilinear weights around directions of any length but zero.
BODICE_LANES void find_stencils(const Chunk (&u)[3], int n, Stencils& at) {
  const float half = 0.5f * static_cast<float>(n - 1);
  const auto last = static_cast<float>(n - 2);
  for (int l = 0; l < kChunk; ++l) {
    const float ax = std::abs(u[0][l]), ay = std::abs(u[1][l]);
    const float scale = 1.0f / greater(ax + ay + std::abs(u[2][l]), 1e-20f);
    float x = u[0][l] * scale, y = u[1][l] * scale;
    const float fx = std::copysign(1.0f - ay * scale, u[0][l]);
    const float fy = std::copysign(1.0f - ax * scale, u[1][l]);
    x = u[2][l] < 0.0f ? fx : x;
    y = u[2][l] < 0.0f ? fy : y;
    // With this order of arguments, greater() returns 0 for NaN.
    const float gx = greater((x + 1.0f) * half, 0.0f), gy = greater((y + 1.0f) * half, 0.0f);
    const auto i = static_cast<std::int32_t>(lesser(gx, last));
    const auto j = static_cast<std::int32_t>(lesser(gy, last));
    const float s = lesser(gx - static_cast<float>(i), 1.0f);
    const float t = lesser(gy - static_cast<float>(j), 1.0f);
    at.first[l] = j * n + i;
    at.weight[0][l] = (1.0f - s) * (1.0f - t);
    at.weight[1][l] = s * (1.0f - t);
    at.weight[2][l] = (1.0f - s) * t;
    at.weight[3][l] = s * t;
  }
}

/// Four values of a table at one lane's direction.
BODICE_LANES void read(const Stencils& at, int lane, const Float4* values, int n, Float4& out) {
  const Float4* const from = values + at.first[lane];
  out = at.weight[0][lane] * from[0] + at.weight[1][lane] * from[1] + at.weight[2][lane] * from[n] +
        at.weight[3][lane] * from[n + 1];
}

/// Four values of a table at all directions, by components.
BODICE_LANES void read_all(const Stencils& at, const Float4* values, int n, Chunk (&out)[4]) {
  for (int l = 0; l < kChunk; l += 4) {
    Float4 found[4];
    for (int k = 0; k < 4; ++k) read(at, l + k, values, n, found[k]);
    transpose(found);
    for (int i = 0; i < 4; ++i) std::memcpy(&out[i][l], &found[i], sizeof(Float4));
  }
}

BODICE_LANES void extend(Range& range, const float* values) {
  for (int l = 0; l < kChunk; ++l) {
    range.low[l] = lesser(values[l], range.low[l]);
    range.high[l] = greater(values[l], range.high[l]);
  }
}

/// Shifts at the directions of the coarser table: shift(w) = change(V w - change(V w)).
BODICE_CLONES
void find_coarse_shifts(const Resampling& to, TableScratch& scratch) {
  const int n = to.nodes, m = shift_nodes(n), count = m * m;
  const Float4* const changes = scratch.changes.data();
  for (int first = 0; first < count; first += kChunk) {
    Chunk target[3], length, found[4];
    Stencils at;
    find_directions(first, m, to.to_table, target, length);
    find_stencils(target, n, at);
    read_all(at, changes, n, found);
    for (int i = 0; i < 3; ++i)
      for (int l = 0; l < kChunk; ++l) target[i][l] -= length[l] * found[i][l];
    find_stencils(target, n, at);
    for (int l = 0; l < kChunk; ++l)
      read(at, l, changes, n, scratch.coarse[static_cast<std::size_t>(first + l)]);
  }
}

/// Position of a row or column of a table among the rows or columns of the coarser table.
struct Between {
  std::int32_t first;
  float weight;  ///< share of the next texel
};

BODICE_LANES Between between(int texel, int n) {
  const int m = shift_nodes(n);
  const float x = static_cast<float>(texel) * (static_cast<float>(m - 1) / static_cast<float>(n - 1));
  const auto first = static_cast<std::int32_t>(lesser(x, static_cast<float>(m - 2)));
  return {first, lesser(x - static_cast<float>(first), 1.0f)};
}

/// Shifts of all texels, by components: bilinear, first along the rows of the coarser table, then across
/// them.
BODICE_CLONES
void spread_shifts(int n, TableScratch& scratch) {
  const int m = shift_nodes(n), stride = n + kLanes;
  for (int c = 0; c < n; c += 4) {
    Between at[4];
    for (int k = 0; k < 4; ++k) at[k] = between(c + k < n ? c + k : n - 1, n);
    for (int j = 0; j < m; ++j) {
      const Float4* const row = scratch.coarse.data() + j * m;
      Float4 v[4];
      for (int k = 0; k < 4; ++k)
        v[k] = (1.0f - at[k].weight) * row[at[k].first] + at[k].weight * row[at[k].first + 1];
      transpose(v);
      for (int i = 0; i < 3; ++i) std::memcpy(scratch.wide[i].data() + j * stride + c, &v[i], sizeof(Float4));
    }
  }
  for (int i = 0; i < 3; ++i)
    for (int row = 0; row < n; ++row) {
      const auto [j, t] = between(row, n);
      const float* const from = scratch.wide[i].data() + j * stride;
      float* const to = scratch.shift[i].data() + row * n;
      // Values beyond the end of a row are overwritten by the next row.
      for (int first = 0; first < n; first += kLanes)
        for (int c = first; c < first + kLanes; ++c) to[c] = (1.0f - t) * from[c] + t * from[stride + c];
    }
}

}  // namespace

void find_shifts(const Resampling& to, TableScratch& scratch) {
  find_coarse_shifts(to, scratch);
  spread_shifts(to.nodes, scratch);
}

BODICE_CLONES
void resample(Resampling& to, const std::uint8_t* buried, TableScratch& scratch) {
  const int n = to.nodes, count = n * n;
  const Float4* const rest = scratch.rest.data();
  const float least_m = to.least_m, most_m = to.most_m, scale = to.scale, inverse_out = to.inverse_out;
  const float per_step = to.per_step;
  for (int first = 0; first < count; first += kChunk) {
    Chunk u[3], length, found[4];
    Stencils at;
    find_directions(first, n, to.to_table, u, length);
    for (int i = 0; i < 3; ++i) {
      const float* const shift = scratch.shift[i].data() + first;
      for (int l = 0; l < kChunk; ++l) u[i][l] -= length[l] * shift[l];
    }
    find_stencils(u, n, at);
    std::int32_t nearest[kChunk];
    for (int l = 0; l < kChunk; ++l)
      nearest[l] = at.first[l] + (at.weight[1][l] + at.weight[3][l] >= 0.5f ? 1 : 0) +
                   (at.weight[2][l] + at.weight[3][l] >= 0.5f ? n : 0);
    read_all(at, rest, n, found);
    float* const h = scratch.h.data() + first;
    float* const a = scratch.a.data() + first;
    std::uint8_t* const burial = scratch.burial.data() + first;
    for (int l = 0; l < kChunk; ++l) {
      const float slope = greater(1.0f - found[1][l] * inverse_out, static_cast<float>(kLeastSlope));
      const float height = scale * found[0][l] + found[2][l] * slope;
      h[l] = lesser(greater(height, least_m), most_m);
      a[l] = lesser(greater(scale * found[1][l], least_m), -least_m);
    }
    std::int32_t yield[kChunk];
    for (int l = 0; l < kChunk; ++l)
      yield[l] = static_cast<std::int32_t>(per_step * yield_m(to.yield, found[2][l]) + 0.5f);
    // The nearest texel's: between texels that are buried and others none is made that is so a little.
    for (int l = 0; l < kChunk; ++l) {
      const std::int32_t depth = buried[nearest[l]] + yield[l];
      burial[l] = static_cast<std::uint8_t>(depth < 255 ? depth : 255);
    }
    // Lanes beyond the table repeat its last texel, but for their shifts.
    if (first + kChunk > count)
      for (int l = count - first; l < kChunk; ++l) h[l] = h[0], a[l] = a[0];
    extend(to.h, h);
    extend(to.a, a);
  }
}

}  // namespace bodice::binding
