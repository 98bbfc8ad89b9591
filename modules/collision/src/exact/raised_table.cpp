#include "exact/raised_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "exact/relief_field.hpp"

namespace bodice::inline v0_1::collision {
namespace {

/// The range of heights that a flat table is given, so that its step is not zero.
constexpr float kLeastRange_m = 1e-6f;

void add_rise(const UnionField& field, const ReliefTables& relief, const UncoveredPoint& point,
              std::span<float> rise_m) {
  const geometry::Vec3 p = Eigen::Map<const Eigen::Vector3f>(point.at).cast<double>();
  const TexelStencil around =
      texels_around(field, relief, point.owner, geometry::closest_point(field.shape(point.owner), p));
  double squares = 0.0;
  for (const double weight : around.weight) squares += weight * weight;
  for (int i = 0; i < 4; ++i) {
    float& rise = rise_m[around.texel[i]];
    rise = std::max(rise, point.rise_m * static_cast<float>(around.weight[i] / squares));
  }
}

/// Border texels of one direction rise alike: see the octahedral map in bodice/proxy/proxy_distance.hpp.
void make_border_alike(std::size_t n, std::span<float> rise_m) {
  const auto make_alike = [&](std::size_t a, std::size_t b) {
    rise_m[a] = rise_m[b] = std::max(rise_m[a], rise_m[b]);
  };
  for (int pass = 0; pass < 2; ++pass)  // the corners, which are one direction, take two
    for (std::size_t i = 0; i < n; ++i) {
      make_alike(i, n - 1 - i);
      make_alike((n - 1) * n + i, n * n - 1 - i);
      make_alike(i * n, (n - 1 - i) * n);
      make_alike(i * n + n - 1, (n - 1 - i) * n + n - 1);
    }
}

/// Adds the rise to a table's heights. Those that rise are rounded upward.
void write(std::span<const float> rise_m, ReliefTables& relief, BakedTable& table) {
  std::uint8_t* const texels = relief.texels.data() + table.first_byte;
  const auto height_m = [&](std::size_t i) {
    return table.h_offset_m + table.h_scale_m * static_cast<float>(texels[2 * i]) + rise_m[i];
  };
  float low_m = std::numeric_limits<float>::max(), high_m = std::numeric_limits<float>::lowest();
  for (std::size_t i = 0; i < rise_m.size(); ++i) {
    low_m = std::min(low_m, height_m(i));
    high_m = std::max(high_m, height_m(i));
  }
  const float step_m = std::max(high_m - low_m, kLeastRange_m) / 255.0f;
  for (std::size_t i = 0; i < rise_m.size(); ++i) {
    const float steps = (height_m(i) - low_m) / step_m;
    const float whole = rise_m[i] > 0.0f ? std::ceil(steps) : std::round(steps);
    texels[2 * i] = static_cast<std::uint8_t>(std::clamp(whole, 0.0f, 255.0f));
  }
  table.h_scale_m = step_m;
  table.h_offset_m = low_m;
}

}  // namespace

void raise_table(const UnionField& field, std::span<const UncoveredPoint> points, ReliefTables& relief,
                 std::span<float> rise_m) {
  if (points.empty()) return;
  const std::uint32_t owner = points.front().owner;
  BakedTable& table = relief.tables[owner];
  const auto nodes = static_cast<std::size_t>(table.nodes);
  std::ranges::fill(rise_m, 0.0f);
  for (const UncoveredPoint& point : points) add_rise(field, relief, point, rise_m);
  make_border_alike(nodes, rise_m);
  write(rise_m, relief, table);
  relief.bound_again(owner);
}

}  // namespace bodice::collision
