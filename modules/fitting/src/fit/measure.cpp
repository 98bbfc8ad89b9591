#include "fit/measure.hpp"

#include <algorithm>
#include <cmath>

#include <bodice/engine/parallel.hpp>
#include <bodice/fitting/enclose_parts.hpp>
#include <bodice/geometry/ellipsoid.hpp>
#include <bodice/geometry/sampling.hpp>
#include <bodice/proxy/proxy_distance.hpp>

#include "base/ellipsoid_surface.hpp"
#include "base/interior_grid.hpp"

namespace bodice::inline v0_1::fitting {
namespace {

constexpr std::size_t kSurfaceSamples = 6000;   // points of the proxy's surface, distributed by area
constexpr std::size_t kSkinSamples = 4000;      // points of the skin
constexpr std::size_t kInteriorSamples = 3000;  // about so many points of the interior
constexpr std::size_t kPointGrain = 64;         // points a task

/// A point of one ellipsoid's surface at which the gap is measured.
struct GapProbe {
  SurfaceProbe at;
  std::uint32_t ellipsoid = 0;
  double gap_m = -1.0;  ///< negative: the point does not lie on the union's surface
};

std::vector<GapProbe> gap_probes(const proxy::BodyProxy::Data& proxy) {
  double total = 0.0;
  for (const auto& e : proxy.ellipsoids) total += surface_area(e.shape.radii);
  std::vector<GapProbe> probes;
  for (std::uint32_t k = 0; k < proxy.ellipsoids.size(); ++k) {
    const geometry::Ellipsoid& e = proxy.ellipsoids[k].shape;
    const int n = std::max(24, static_cast<int>(kSurfaceSamples * surface_area(e.radii) / total));
    for (const SurfaceProbe& at : probe_surface(e, n)) probes.push_back({at, k});
  }
  return probes;
}

/// Finds the outermost F = 0 on the ellipsoid's own normal through the probe; false if there is none, or if
/// another ellipsoid owns it.
bool find_on_normal(const proxy::BodyProxy::Data& proxy, GapProbe& probe, double reach_m) {
  constexpr int kSteps = 48, kHalvings = 24;
  const geometry::Ellipsoid& shape = proxy.ellipsoids[probe.ellipsoid].shape;
  const Vec3 start = probe.at.point, normal = geometry::closest_point(shape, start).normal;
  const auto at = [&](double t) { return proxy::proxy_distance(proxy, start + t * normal); };
  double outside = reach_m;
  for (int step = 1; step <= kSteps; ++step) {
    const double inside = reach_m * (1.0 - 2.0 * step / kSteps);
    if (at(inside).distance > 0.0) {
      outside = inside;
      continue;
    }
    double low = inside, high = outside;
    for (int halving = 0; halving < kHalvings; ++halving) {
      const double middle = 0.5 * (low + high);
      (at(middle).distance > 0.0 ? high : low) = middle;
    }
    probe.at.point = start + high * normal;
    return at(high).owner == probe.ellipsoid;
  }
  return false;
}

/// Moves a probe onto F = 0 along the gradient; false if another ellipsoid owns it there. Steep tables may
/// lead the steps past each other: then F = 0 is looked for on a line.
bool settle(const proxy::BodyProxy::Data& proxy, GapProbe& probe, double tolerance_m) {
  constexpr int kSteps = 8;
  // Tables reach no farther to either side than this share of the stature.
  constexpr double kSearched = 0.05;
  const Vec3 start = probe.at.point;
  for (int step = 0; step < kSteps; ++step) {
    const proxy::ProxyDistance f = proxy::proxy_distance(proxy, probe.at.point);
    if (std::abs(f.distance) <= tolerance_m) return f.owner == probe.ellipsoid;
    if (step == 0 && proxy.relief.empty() && f.distance < -proxy.margin_m - tolerance_m) return false;
    probe.at.point -= f.distance * f.normal;
  }
  if (proxy.relief.empty()) return false;
  probe.at.point = start;
  return find_on_normal(proxy, probe, kSearched * proxy.stature_m);
}

/// Enclosing ellipsoids of the parts that are not wanted.
std::vector<geometry::Ellipsoid> about_others(const engine::Context& context, const LabeledSkin& skin,
                                              std::uint32_t parts) {
  std::vector<geometry::Ellipsoid> shapes;
  if ((parts & kAllParts) == kAllParts) return shapes;
  const auto others = enclose_parts(context, skin, kAllParts & ~parts);
  if (!others) return shapes;  // these parts have no skin
  for (const proxy::ProxyEllipsoid& e : others->ellipsoids()) shapes.push_back(e.shape);
  return shapes;
}

/// Whether a point of the proxy's surface lies where the body goes on in a part that is not wanted. The proxy
/// is cut there, not next to skin, so that the distance to the nearest skin is no gap. Such a point is inside
/// the body, and inside the other part's ellipsoid or close to it with the nearest skin to the side.
bool is_cut(const proxy::BodyProxy::Data& proxy, const geometry::SurfacePoint& skin, const Vec3& at,
            const std::vector<geometry::Ellipsoid>& others) {
  constexpr double kBeside = 1.5 * 1.5;  // level: 1.5 times the radii of the part's enclosing ellipsoid
  constexpr double kAhead = 0.5;         // cosine between the surface's normal and the direction to the skin
  const Vec3 to_skin = skin.point - at;
  if (others.empty() || to_skin.dot(skin.normal) <= 0.0) return false;
  double nearest = kBeside;
  for (const geometry::Ellipsoid& shape : others) nearest = std::min(nearest, geometry::level(shape, at));
  if (nearest < 1.0) return true;
  return nearest < kBeside &&
         proxy::proxy_distance(proxy, at).normal.dot(to_skin.stableNormalized()) < kAhead;
}

/// The gaps of one part's ellipsoids; of all ellipsoids if `part` is negative.
Spread gaps(const std::vector<GapProbe>& probes, const proxy::BodyProxy::Data& proxy, int part) {
  std::vector<std::pair<double, double>> values;
  for (const GapProbe& p : probes)
    if (p.gap_m >= 0.0 && (part < 0 || static_cast<int>(proxy.ellipsoids[p.ellipsoid].part) == part))
      values.emplace_back(p.gap_m, p.at.area);
  return spread_of(std::move(values));
}

/// Raises the largest gaps where points above the skin lie inside the proxy. A lump of relief may have no
/// probe: its surface is not where the ellipsoid's is.
void measure_lumps(const engine::Context& context, const proxy::BodyProxy::Data& proxy,
                   const LabeledSkin& skin, const geometry::MeshDistance& distance, Measured& measured) {
  // Shares of the stature: 10, 25 and 50 mm.
  constexpr double kHeights[] = {0.006, 0.015, 0.03};
  struct Lump {
    double gap_m = 0.0;
    std::uint32_t owner = 0;
  };
  const auto samples = geometry::sample_surface(skin.mesh, kSkinSamples, 2);
  std::vector<Lump> lumps(samples.size());
  engine::parallel_for(context, samples.size(), kPointGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      for (const double height : kHeights) {
        const Vec3 normal = geometry::area_vector(skin.mesh, samples[i].triangle).stableNormalized();
        const Vec3 p = samples[i].point + height * skin.stature_m * normal;
        const proxy::ProxyDistance f = proxy::proxy_distance(proxy, p);
        if (f.distance < 0.0) lumps[i] = {std::max(lumps[i].gap_m, distance.signed_distance(p)), f.owner};
      }
  });
  for (const Lump& lump : lumps) {
    if (lump.gap_m <= 0.0) continue;
    Spread& part = measured.gap_of_part[static_cast<std::size_t>(proxy.ellipsoids[lump.owner].part)];
    part.max = std::max(part.max, lump.gap_m);
    measured.accuracy.gap_m.max = std::max(measured.accuracy.gap_m.max, lump.gap_m);
  }
}

void measure_skin(const engine::Context& context, const proxy::BodyProxy::Data& proxy,
                  const LabeledSkin& skin, std::uint32_t parts, double tolerance_m, FitAccuracy& accuracy) {
  const auto samples = geometry::sample_surface(skin.mesh, kSkinSamples, 1);
  std::vector<double> outside(samples.size(), -1.0);
  engine::parallel_for(context, samples.size(), kPointGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const geometry::Index corner = skin.mesh.triangles[samples[i].triangle][0];
      if ((parts >> static_cast<int>(skin.part[corner])) & 1u)
        outside[i] = std::max(0.0, proxy::proxy_distance(proxy, samples[i].point).distance);
    }
  });
  double counted = 0.0, uncovered = 0.0;
  for (const double depth : outside) {
    if (depth < 0.0) continue;
    counted += 1.0;
    uncovered += depth > tolerance_m;
    accuracy.skin_outside_depth_m =
        std::max(accuracy.skin_outside_depth_m, depth > tolerance_m ? depth : 0.0);
  }
  accuracy.skin_outside_percent = counted > 0.0 ? 100.0 * uncovered / counted : 0.0;
}

/// The share of interior grid points inside the proxy, over the points nearest to skin of wanted parts.
void measure_interior(const engine::Context& context, const proxy::BodyProxy::Data& proxy,
                      const LabeledSkin& skin, const geometry::MeshDistance& distance, std::uint32_t parts,
                      FitAccuracy& accuracy) {
  const double volume = std::abs(geometry::signed_volume(skin.mesh));
  const std::vector<Vec3> grid = interior_grid(skin.mesh, std::cbrt(volume / kInteriorSamples));
  std::vector<std::int8_t> state(grid.size(), -1);
  const bool all_parts = parts == kAllParts;
  engine::parallel_for(context, grid.size(), kPointGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto hit =
          all_parts ? std::nullopt : distance.closest_point_within(grid[i], 10.0 * skin.stature_m);
      if (!all_parts && !hit) continue;
      const auto part = hit ? static_cast<int>(skin.part[skin.mesh.triangles[hit->triangle][0]]) : 0;
      if (all_parts || ((parts >> part) & 1u))
        state[i] = proxy::proxy_distance(proxy, grid[i]).distance <= 0.0;
    }
  });
  const auto inside = std::count_if(state.begin(), state.end(), [](std::int8_t s) { return s >= 0; });
  const auto covered = std::count(state.begin(), state.end(), std::int8_t{1});
  accuracy.interior_covered_percent =
      inside > 0 ? 100.0 * static_cast<double>(covered) / static_cast<double>(inside) : 100.0;
}

}  // namespace

Spread spread_of(std::vector<std::pair<double, double>> values) {
  Spread spread;
  double total = 0.0;
  for (const auto& [value, weight] : values) {
    total += weight;
    spread.mean += weight * value;
    spread.max = std::max(spread.max, value);
  }
  if (!(total > 0.0)) return spread;
  spread.mean /= total;
  std::sort(values.begin(), values.end());
  double running = 0.0;
  for (const auto& [value, weight] : values) {
    running += weight;
    spread.p95 = value;
    if (running >= 0.95 * total) break;
  }
  return spread;
}

Measured measure(const engine::Context& context, const proxy::BodyProxy::Data& proxy, const LabeledSkin& skin,
                 const geometry::MeshDistance& distance, std::uint32_t parts) {
  const double tolerance_m = 1e-6 * skin.stature_m;  // about a micrometer: a closer point is on the surface
  std::vector<GapProbe> probes = gap_probes(proxy);
  const std::vector<geometry::Ellipsoid> others = about_others(context, skin, parts);
  engine::parallel_for(context, probes.size(), kPointGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      if (settle(proxy, probes[i], tolerance_m))
        if (const auto hit = distance.closest_point_within(probes[i].at.point, 10.0 * skin.stature_m);
            hit && !is_cut(proxy, *hit, probes[i].at.point, others))
          probes[i].gap_m = std::abs(hit->signed_distance);
  });
  Measured result;
  result.accuracy.gap_m = gaps(probes, proxy, -1);
  for (int part = 0; part < body::kAllPartCount; ++part) result.gap_of_part[part] = gaps(probes, proxy, part);
  if (!proxy.relief.empty() && others.empty()) measure_lumps(context, proxy, skin, distance, result);
  measure_skin(context, proxy, skin, parts, tolerance_m, result.accuracy);
  measure_interior(context, proxy, skin, distance, parts, result.accuracy);
  return result;
}

}  // namespace bodice::fitting
