#include "relief.hpp"

#include <algorithm>
#include <cmath>

#include <bodice/proxy/proxy_distance.hpp>

namespace bodice::collision {

namespace {

/// The order in which BakedEllipsoid stores the axes, inverted.
void find_sorted_axes(const geometry::Vec3& radii, std::int32_t (&sorted_axis)[3]) {
  int order[3] = {0, 1, 2};
  std::sort(order, order + 3, [&](int a, int b) { return radii[a] > radii[b]; });
  for (int i = 0; i < 3; ++i) sorted_axis[order[i]] = i;
}

}  // namespace

ReliefTables::ReliefTables(const proxy::BodyProxy& proxy, std::span<const std::uint32_t> order) {
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
  for (const std::uint32_t k : order) {
    const proxy::ReliefTable& from = proxy.relief()[k];
    BakedTable table;
    find_sorted_axes(proxy.ellipsoids()[k].shape.radii, table.sorted_axis);
    if (from.nodes_per_side == 0) {
      tables.push_back(table);  // flat: of two nodes and no height
      top_m.push_back(0.0f);
      steep.push_back(0.0f);
      continue;
    }
    table.first_byte = static_cast<std::int32_t>(2 * from.first_texel);
    table.nodes = from.nodes_per_side;
    table.h_scale_m = from.h_scale_m / 255.0f;
    table.h_offset_m = from.h_offset_m;
    table.a_scale = from.a_scale / 255.0f / out_m;
    table.a_offset = from.a_offset / out_m;
    tables.push_back(table);
    const float h = std::max(from.h_offset_m, from.h_offset_m + from.h_scale_m);
    const float a = std::max(std::abs(from.a_offset), std::abs(from.a_offset + from.a_scale));
    top_m.push_back(h);
    steep.push_back(a / out_m);
    highest_m = std::max(highest_m, h + a * std::max(in_m, out_m) / out_m);
  }
  top_m.push_back(*std::max_element(top_m.begin(), top_m.end()));
  steep.push_back(*std::max_element(steep.begin(), steep.end()));
}

}  // namespace bodice::collision
