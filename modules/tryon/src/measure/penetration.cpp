#include <bodice/tryon/penetration.hpp>

#include <algorithm>
#include <functional>

#include <Eigen/Geometry>

#include <bodice/engine/parallel.hpp>
#include <bodice/proxy/proxy_distance.hpp>

namespace bodice::inline v0_1::tryon {
namespace {

using geometry::Vec3;

constexpr std::size_t kParticleGrain = 256;  // particles a block: about a millisecond of signed distances
// A particle counts as inside the proxy beyond these depths, in statures. They are the rounding of float
// positions, and with relief the error that the collider certifies (0.05 mm at 1.7 m).
constexpr double kInsideTolerance = 1e-6;
constexpr double kReliefTolerance = 0.05e-3 / 1.7;

struct Area {
  double inside = 0.0, all = 0.0;
};

double inside_tolerance_m(const proxy::BodyProxy& proxy) {
  return (proxy.relief().empty() ? kInsideTolerance : kReliefTolerance) * proxy.stature_m();
}

/// The number of finite positions that are deeper than the tolerance.
template <class Distance>
std::size_t count_deeper(const engine::Context& context, std::span<const Vec3> positions, double tolerance_m,
                         Distance distance) {
  return engine::ordered_reduce(
      context, positions.size(), kParticleGrain, std::size_t{0},
      [&](std::size_t begin, std::size_t end) {
        std::size_t inside = 0;
        for (const Vec3& p : positions.subspan(begin, end - begin))
          inside += p.allFinite() && distance(p) < -tolerance_m;
        return inside;
      },
      std::plus<>());
}

}  // namespace

Penetration penetration(const engine::Context& context, const geometry::MeshDistance& skin,
                        std::span<const Vec3> positions) {
  return engine::ordered_reduce(
      context, positions.size(), kParticleGrain, Penetration{},
      [&](std::size_t begin, std::size_t end) {
        Penetration found;
        for (std::size_t i = begin; i < end; ++i) {
          if (!positions[i].allFinite()) continue;
          const double depth_m = -skin.signed_distance(positions[i]);
          found.deepest_m = std::max(found.deepest_m, depth_m);
          found.over_1mm += depth_m > kDeep_m;
        }
        return found;
      },
      [](const Penetration& a, const Penetration& b) {
        return Penetration{std::max(a.deepest_m, b.deepest_m), a.over_1mm + b.over_1mm};
      });
}

std::size_t count_inside(const engine::Context& context, const proxy::BodyProxy& proxy,
                         std::span<const Vec3> positions) {
  return count_deeper(context, positions, inside_tolerance_m(proxy),
                      [&](const Vec3& p) { return proxy::proxy_distance(proxy, p).distance; });
}

std::size_t count_inside(const engine::Context& context, const proxy::BodyProxy& bound,
                         const proxy::PosedProxy& posed, std::span<const Vec3> positions) {
  return count_deeper(context, positions, inside_tolerance_m(bound) * posed.scale,
                      [&](const Vec3& p) { return proxy::posed_proxy_distance(bound, posed, p).distance; });
}

double pierced_share(const engine::Context& context, const geometry::MeshDistance& skin,
                     std::span<const Vec3> positions, std::span<const geometry::Triangle> triangles) {
  const Area area = engine::ordered_reduce(
      context, triangles.size(), kParticleGrain, Area{},
      [&](std::size_t begin, std::size_t end) {
        Area found;
        for (std::size_t t = begin; t < end; ++t) {
          const Vec3 &a = positions[triangles[t][0]], &b = positions[triangles[t][1]],
                     &c = positions[triangles[t][2]];
          const double twice_area = (b - a).cross(c - a).norm();
          if (!(twice_area > 0.0)) continue;
          found.all += twice_area;
          if (skin.signed_distance((a + b + c) / 3.0) < 0.0) found.inside += twice_area;
        }
        return found;
      },
      [](const Area& a, const Area& b) {
        return Area{a.inside + b.inside, a.all + b.all};
      });
  return area.all > 0.0 ? area.inside / area.all : 0.0;
}

}  // namespace bodice::tryon
