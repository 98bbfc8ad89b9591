#include "bind/burial.hpp"

#include <algorithm>
#include <cmath>

#include <bodice/engine/parallel.hpp>
#include <bodice/proxy/proxy_distance.hpp>

#include "bind/texel_directions.hpp"

namespace bodice::inline v0_1::binding {
namespace {

using geometry::Vec3;

/// The depth of a point in the ellipsoid that holds it deepest, other than k; zero outside of all.
double depth_in_others(const proxy::BodyProxy& proxy, std::size_t k, const Vec3& point) {
  double depth = 0.0;
  for (std::size_t j = 0; j < proxy.ellipsoids().size(); ++j) {
    const geometry::Ellipsoid& e = proxy.ellipsoids()[j].shape;
    // No point inside is deeper than the least radius.
    if (j == k || e.radii.minCoeff() <= depth) continue;
    const double longest = e.radii.maxCoeff();
    if ((point - e.center).squaredNorm() >= longest * longest || geometry::level(e, point) >= 1.0) continue;
    depth = std::max(depth, -geometry::closest_point(e, point).signed_distance);
  }
  return depth;
}

}  // namespace

Burial find_burial(const engine::Context& context, const proxy::BodyProxy& proxy) {
  const double from_m = proxy::relief_reach(proxy.stature_m()).blend_m;
  std::vector<double> depth(proxy.texels().size(), 0.0);
  engine::parallel_for(context, proxy.relief().size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const proxy::ReliefTable& table = proxy.relief()[k];
      const int n = table.nodes_per_side;
      for (int i = 0; i < n * n; ++i) {
        if (i % n == 0) context.checkpoint();
        const Vec3 point = surface_point(proxy.ellipsoids()[k].shape, texel_direction(i, n));
        depth[table.first_texel + static_cast<std::size_t>(i)] =
            std::max(0.0, depth_in_others(proxy, k, point) - from_m);
      }
    }
  });
  // Twelve blends are depth enough to yield to any other ellipsoid.
  const double most = std::min(12.0 * from_m, depth.empty() ? 0.0 : *std::ranges::max_element(depth));
  Burial burial;
  burial.step_m = static_cast<float>(most / 255.0);
  burial.depth.resize(depth.size());
  for (std::size_t i = 0; i < depth.size(); ++i)
    if (most > 0.0)
      burial.depth[i] = static_cast<std::uint8_t>(std::lround(255.0 * std::min(1.0, depth[i] / most)));
  return burial;
}

}  // namespace bodice::binding
