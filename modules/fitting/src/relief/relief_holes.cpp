#include "relief/relief_holes.hpp"

#include <algorithm>
#include <cmath>

#include <bodice/engine/parallel.hpp>
#include <bodice/engine/random.hpp>
#include <bodice/proxy/proxy_distance.hpp>

namespace bodice::inline v0_1::fitting {
namespace {

constexpr int kProbes = 3;  // probes a cell and depth
/// Probed depths below the ellipsoid's surface, fractions of the tables' reach; beyond it the correction is
/// constant.
constexpr double kDepths[] = {0.25, 0.35, 0.5, 0.7, 1.0};

/// A table as its nodes define it.
struct TableView {
  const proxy::ReliefTable& table;
  std::span<const proxy::ReliefTexel> texels;
  proxy::ReliefReach reach;

  /// The largest corrected distance that a node of cell (i, j) gives at depth d.
  double largest(int i, int j, double d) const {
    const int n = table.nodes_per_side;
    double most = -reach.in_m;
    for (const int node : {j * n + i, j * n + i + 1, (j + 1) * n + i, (j + 1) * n + i + 1}) {
      const proxy::ReliefTexel t = texels[table.first_texel + static_cast<std::uint32_t>(node)];
      const double h = static_cast<double>(table.h_offset_m + table.h_scale_m * t.h / 255.0f);
      const double a = static_cast<double>(table.a_offset + table.a_scale * t.a / 255.0f);
      most = std::max(most, d - h - a * std::max(d, -reach.in_m) / reach.out_m);
    }
    return most;
  }
};

/// The point at signed distance d from the ellipsoid's surface, in the direction of a point of the table's
/// square.
Vec3 below(const geometry::Ellipsoid& e, double x, double y, double d) {
  const Vec3 w = proxy::octahedral_direction(x, y);
  return e.center + e.axes * (e.radii.cwiseProduct(w) + d * w.cwiseQuotient(e.radii).normalized());
}

}  // namespace

std::vector<Vec3> find_holes(const engine::Context& context, const FreeSkin& skin,
                             const proxy::BodyProxy::Data& proxy, double depth_m, double margin_m) {
  const proxy::ReliefReach reach = proxy::relief_reach(proxy.stature_m);
  const auto is_hole = [&](const Vec3& p) {
    if (proxy::proxy_distance(proxy, p).distance < -margin_m) return false;
    return !skin.closest_point_within(p, depth_m) && skin.inside(p);
  };
  std::vector<std::vector<Vec3>> of_each(proxy.ellipsoids.size());
  engine::parallel_for(context, of_each.size(), 1, [&](std::size_t k, std::size_t) {
    const engine::Random random(29, k);
    const TableView view{proxy.relief[k], proxy.texels, reach};
    const int n = view.table.nodes_per_side;
    std::uint64_t drawn = 0;
    for (int cell = 0; cell < (n - 1) * (n - 1); ++cell)
      for (const double depth : kDepths) {
        const int i = cell % (n - 1), j = cell / (n - 1);
        if (view.largest(i, j, -depth * reach.in_m) < -margin_m) continue;
        for (int probe = 0; probe < kProbes; ++probe, drawn += 2) {
          const double x = 2.0 * (i + random.uniform_at(drawn)) / (n - 1) - 1.0;
          const double y = 2.0 * (j + random.uniform_at(drawn + 1)) / (n - 1) - 1.0;
          const Vec3 p = below(proxy.ellipsoids[k].shape, x, y, -depth * reach.in_m);
          if (is_hole(p)) of_each[k].push_back(p);
        }
      }
  });
  std::vector<Vec3> holes;
  for (const auto& found : of_each) holes.insert(holes.end(), found.begin(), found.end());
  return holes;
}

}  // namespace bodice::fitting
