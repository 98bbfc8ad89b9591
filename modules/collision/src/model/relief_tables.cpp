#include "model/relief_tables.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include <bodice/proxy/proxy_distance.hpp>

namespace bodice::inline v0_1::collision {

namespace {

/// For each axis of the proxy, its index in BakedEllipsoid.
void find_sorted_axes(const geometry::Vec3& radii, std::int32_t (&sorted_axis)[3]) {
  const std::array<int, 3> axes = geometry::axes_by_radius(radii);
  for (int i = 0; i < 3; ++i) sorted_axis[axes[i]] = i;
}

/// The texels of one table, scaled to meters.
class Heights {
 public:
  Heights(const proxy::BodyProxy& proxy, const proxy::ReliefTable& table, const proxy::ReliefReach& reach)
      : texels_(proxy.texels().subspan(table.first_texel)), table_(table), reach_(reach) {}

  /// The largest distance d at which d - h - a clamp(d, -in, out) / out <= 0 for one texel.
  double zero_m(int column, int row) const {
    const proxy::ReliefTexel& t =
        texels_[static_cast<std::size_t>(row) * table_.nodes_per_side + static_cast<std::size_t>(column)];
    const double h = double{table_.h_offset_m} + double{table_.h_scale_m} * t.h / 255.0;
    const double a = slope(t);
    if (a >= kSteepest) return h + a * std::max(reach_.in_m, reach_.out_m);
    const double between = h / (1.0 - a);
    if (between > reach_.out_m) return h + a * reach_.out_m;
    return between < -reach_.in_m ? h - a * reach_.in_m : between;
  }
  /// The largest slope below kSteepest, and the largest magnitude of all slopes.
  std::pair<double, double> steepest() const {
    double rising = 0.0, any = 0.0;
    const std::size_t count = std::size_t{table_.nodes_per_side} * table_.nodes_per_side;
    for (const proxy::ReliefTexel& t : texels_.first(count)) {
      const double a = slope(t);
      if (a < kSteepest) rising = std::max(rising, a);
      any = std::max(any, std::abs(a));
    }
    return {rising, any};
  }

 private:
  static constexpr double kSteepest = 0.9;  // steeper ones are taken at the end of the clamp

  double slope(const proxy::ReliefTexel& t) const {
    return (double{table_.a_offset} + double{table_.a_scale} * t.a / 255.0) / reach_.out_m;
  }

  std::span<const proxy::ReliefTexel> texels_;
  const proxy::ReliefTable& table_;
  const proxy::ReliefReach& reach_;
};

/// Whether an interval reaches the negative (or positive) half of the axis; touching it counts.
bool touches_half(bool negative, double low, double high) {
  constexpr double kTouching = 1e-4;
  return negative ? low < kTouching : high > -kTouching;
}

/// Between nodes both numbers are bilinear, so that the largest value at a cell's corners bounds those inside
/// it.
OctantReach reach_of(const Heights& heights, int nodes) {
  OctantReach result;
  std::fill(std::begin(result.at_zero_m), std::end(result.at_zero_m), -std::numeric_limits<float>::max());
  const auto coordinate = [&](int i) { return 2.0 * i / (nodes - 1) - 1.0; };
  for (int row = 0; row + 1 < nodes; ++row)
    for (int column = 0; column + 1 < nodes; ++column) {
      const double x[2] = {coordinate(column), coordinate(column + 1)},
                   y[2] = {coordinate(row), coordinate(row + 1)};
      const auto zero_m = static_cast<float>(
          std::max({heights.zero_m(column, row), heights.zero_m(column + 1, row),
                    heights.zero_m(column, row + 1), heights.zero_m(column + 1, row + 1)}));
      // z is positive where |x| + |y| < 1.
      double z[2] = {1.0, 1.0};
      for (const auto* side : {x, y}) {
        const double low = std::abs(side[0]), high = std::abs(side[1]);
        z[0] -= std::max(low, high);
        z[1] -= side[0] < 0.0 && side[1] > 0.0 ? 0.0 : std::min(low, high);
      }
      for (int octant = 0; octant < 8; ++octant)
        if (touches_half(octant & 1, x[0], x[1]) && touches_half(octant & 2, y[0], y[1]) &&
            touches_half(octant & 4, z[0], z[1]))
          result.at_zero_m[octant] = std::max(result.at_zero_m[octant], zero_m);
    }
  const auto [rising, any] = heights.steepest();
  result.rise = static_cast<float>(1.0 / (1.0 - rising));
  result.fall = static_cast<float>(1.0 / (1.0 + any));
  return result;
}

OctantReach farthest_of(const std::vector<OctantReach>& reaches) {
  OctantReach result = reaches.front();
  for (const OctantReach& reach : reaches) {
    for (int i = 0; i < 8; ++i) result.at_zero_m[0] = std::max(result.at_zero_m[0], reach.at_zero_m[i]);
    result.rise = std::max(result.rise, reach.rise);
    result.fall = std::min(result.fall, reach.fall);
  }
  std::fill(std::begin(result.at_zero_m), std::end(result.at_zero_m), result.at_zero_m[0]);
  return result;
}

/// Bounds of a posed table, the same for all octants. The values of each texel are looked at once, in float.
OctantReach reach_in_pose(const BakedTable& table, const std::uint8_t* texels, float in_m, float out_m) {
  constexpr float kSteepest = 0.9f;  // as in Heights
  constexpr float kRounding_m = 1e-6f;
  float zero_m = -std::numeric_limits<float>::max(), rising = 0.0f, any = 0.0f;
  const int count = table.nodes * table.nodes;
  for (int i = 0; i < count; ++i) {
    const float h = table.h_offset_m + table.h_scale_m * static_cast<float>(texels[2 * i]);
    const float a = table.a_offset + table.a_scale * static_cast<float>(texels[2 * i + 1]);
    const float between = h / (1.0f - std::min(a, kSteepest));
    const float steep = h + a * std::max(in_m, out_m);
    const float outside = h + a * out_m, inside = h - a * in_m;
    const float gentle = between > out_m ? outside : between < -in_m ? inside : between;
    zero_m = std::max(zero_m, a >= kSteepest ? steep : gentle);
    rising = std::max(rising, a < kSteepest ? a : 0.0f);
    any = std::max(any, std::abs(a));
  }
  OctantReach reach;
  std::fill(std::begin(reach.at_zero_m), std::end(reach.at_zero_m), zero_m + kRounding_m * (1.0f + out_m));
  reach.rise = 1.0f / (1.0f - rising);
  reach.fall = 1.0f / (1.0f + any);
  return reach;
}

}  // namespace

ReliefTables::ReliefTables(const proxy::BodyProxy& proxy, std::span<const std::uint32_t> order,
                           engine::MemoryResource* memory)
    : texels(memory), burial(memory) {
  const proxy::ReliefReach reach = proxy::relief_reach(proxy.stature_m());
  in_m = static_cast<float>(reach.in_m);
  out_m = static_cast<float>(reach.out_m);
  blend_m = static_cast<float>(reach.blend_m);
  texels.reserve(2 * proxy.texels().size() + 4);
  for (const proxy::ReliefTexel& t : proxy.texels()) {
    texels.push_back(t.h);
    texels.push_back(t.a);
  }
  texels.resize(texels.size() + 16);
  if (const proxy::Binding* const binding = proxy.binding(); binding && !binding->burial.empty())
    burial.resize(binding->burial.size() + 16);
  for (const std::uint32_t k : order) {
    const proxy::ReliefTable& from = proxy.relief()[k];
    BakedTable table;
    find_sorted_axes(proxy.ellipsoids()[k].shape.radii, table.sorted_axis);
    if (from.nodes_per_side == 0) {
      tables.push_back(table);  // flat: two nodes a side, zero height
      reaches.emplace_back();
      continue;
    }
    for (int axis = 0; axis < 3; ++axis) sorted_axes = sorted_axes && table.sorted_axis[axis] == axis;
    table.first_byte = static_cast<std::int32_t>(2 * from.first_texel);
    table.nodes = from.nodes_per_side;
    table.h_scale_m = from.h_scale_m / 255.0f;
    table.h_offset_m = from.h_offset_m;
    table.a_scale = from.a_scale / 255.0f / out_m;
    table.a_offset = from.a_offset / out_m;
    tables.push_back(table);
    const float h = std::max(from.h_offset_m, from.h_offset_m + from.h_scale_m);
    const float a = std::max(std::abs(from.a_offset), std::abs(from.a_offset + from.a_scale));
    reaches.push_back(reach_of(Heights(proxy, from, reach), from.nodes_per_side));
    highest_m = std::max(highest_m, h + a * std::max(in_m, out_m) / out_m);
  }
  farthest = farthest_of(reaches);
}

void ReliefTables::bound_again(std::size_t k) {
  reaches[k] = reach_in_pose(tables[k], texels.data() + tables[k].first_byte, in_m, out_m);
}

void ReliefTables::bound_all_again() {
  farthest = farthest_of(reaches);
  highest_m = 0.0f;
  for (const BakedTable& table : tables) {
    const float h = std::max(table.h_offset_m, table.h_offset_m + 255.0f * table.h_scale_m);
    const float a = std::max(std::abs(table.a_offset), std::abs(table.a_offset + 255.0f * table.a_scale));
    highest_m = std::max(highest_m, h + a * std::max(in_m, out_m));
  }
}

void ReliefTables::update(const proxy::PosedProxy& posed, double stature_m,
                          std::span<const std::uint32_t> order) {
  const proxy::ReliefReach reach = proxy::relief_reach(stature_m * posed.scale);
  in_m = static_cast<float>(reach.in_m);
  out_m = static_cast<float>(reach.out_m);
  blend_m = static_cast<float>(reach.blend_m);
  highest_m = 0.0f;
  sorted_axes = true;
  const bool buried = !burial.empty() && posed.burial.size() == posed.texels.size();
  burial_m = buried ? static_cast<float>(proxy::kBurialWeight) * posed.burial_step_m : 0.0f;
  deepest_m = 0.0f;
  if (buried) {
    std::ranges::copy(posed.burial, burial.begin());
    deepest_m = burial_m * static_cast<float>(std::ranges::max(burial));
  }
  for (std::size_t i = 0; i < posed.texels.size(); ++i) {
    texels[2 * i] = posed.texels[i].h;
    texels[2 * i + 1] = posed.texels[i].a;
  }
  for (std::size_t k = 0; k < order.size(); ++k) {
    const proxy::ReliefTable& from = posed.relief[order[k]];
    BakedTable& table = tables[k];
    find_sorted_axes(posed.shapes[order[k]].radii, table.sorted_axis);
    if (from.nodes_per_side == 0) continue;
    for (int axis = 0; axis < 3; ++axis) sorted_axes = sorted_axes && table.sorted_axis[axis] == axis;
    table.h_scale_m = from.h_scale_m / 255.0f;
    table.h_offset_m = from.h_offset_m;
    table.a_scale = from.a_scale / 255.0f / out_m;
    table.a_offset = from.a_offset / out_m;
    const float h = std::max(from.h_offset_m, from.h_offset_m + from.h_scale_m);
    const float a = std::max(std::abs(from.a_offset), std::abs(from.a_offset + from.a_scale));
    reaches[k] = reach_in_pose(table, texels.data() + table.first_byte, in_m, out_m);
    highest_m = std::max(highest_m, h + a * std::max(in_m, out_m) / out_m);
  }
  farthest = farthest_of(reaches);
}

}  // namespace bodice::collision
