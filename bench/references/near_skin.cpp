#include <bench_references/near_skin.hpp>

#include <algorithm>
#include <cmath>

#include <bodice/engine/parallel.hpp>
#include <bodice/engine/random.hpp>
#include <bodice/geometry/sampling.hpp>
#include <bodice/proxy/proxy_distance.hpp>

namespace bench {
namespace {

using namespace bodice;
constexpr double kNear_m = 0.030;
constexpr double kDeep_m = 0.010;

/// Triangles inside another limb, where a posed body interpenetrates. They are no boundary of the body, and
/// the distance to them is no depth.
std::vector<std::uint8_t> buried_triangles(const engine::Context& context, const geometry::TriMesh& mesh,
                                           const geometry::MeshDistance& distance) {
  std::vector<std::uint8_t> buried(mesh.triangles.size());
  engine::parallel_for(context, buried.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      const geometry::Vec3 middle = (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3.0;
      buried[t] = distance.inside(middle + 3e-4 * geometry::area_vector(mesh, t).stableNormalized());
    }
  });
  return buried;
}

}  // namespace

std::vector<Probe> near_skin_probes(const engine::Context& context, const geometry::TriMesh& mesh,
                                    const geometry::MeshDistance& distance) {
  constexpr std::size_t kNearCount = 20000, kInsideCount = 40000;
  const auto skin = geometry::sample_surface(mesh, kNearCount, 77);
  const geometry::Box box = geometry::bounding_box(mesh.positions);
  const auto buried = buried_triangles(context, mesh, distance);
  std::vector<Probe> probes(skin.size() + kInsideCount);
  const engine::Random random(4242);
  engine::parallel_for(context, probes.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const geometry::Vec3 u(random.uniform_at(3 * i), random.uniform_at(3 * i + 1),
                             random.uniform_at(3 * i + 2));
      if (i < skin.size()) {
        // The point is moved along the normal to either side, so that every distance up to 30 mm is equally
        // frequent.
        const geometry::Vec3 n = geometry::area_vector(mesh, skin[i].triangle).normalized();
        probes[i].point = skin[i].point + kNear_m * (2.0 * u.x() - 1.0) * n;
      } else {
        probes[i].point = box.low + u.cwiseProduct(box.size());
      }
      const geometry::SurfacePoint nearest = distance.closest_point(probes[i].point);
      probes[i].signed_distance_m = nearest.signed_distance;
      probes[i].counts = nearest.triangle != geometry::kNoIndex && !buried[nearest.triangle];
    }
  });
  std::erase_if(probes, [](const Probe& p) { return !p.counts; });
  return probes;
}

NearSkin judge(const engine::Context& context, const proxy::BodyProxy& proxy,
               const std::vector<Probe>& probes) {
  std::vector<double> value(probes.size(), 0.0);
  engine::parallel_for(context, probes.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      if (probes[i].signed_distance_m < kNear_m)
        value[i] = proxy::proxy_distance(proxy, probes[i].point).distance;
  });
  NearSkin result;
  std::vector<double> errors;
  double missed = 0.0, hits = 0.0;
  for (std::size_t i = 0; i < probes.size(); ++i) {
    const double s = probes[i].signed_distance_m;
    if (s < -kDeep_m && value[i] > 0.0) ++result.deep_leaks;
    if (std::abs(s) > kNear_m) continue;
    errors.push_back(std::abs(value[i] - s));
    missed += s < -1e-3 && value[i] > 0.0;
    hits += s > 1e-3 && value[i] < 0.0;
  }
  std::sort(errors.begin(), errors.end());
  for (const double e : errors) result.mean_mm += 1e3 * e / static_cast<double>(errors.size());
  result.p95_mm = 1e3 * errors[errors.size() * 95 / 100];
  result.max_mm = 1e3 * errors.back();
  result.missed_percent = 100.0 * missed / static_cast<double>(errors.size());
  result.false_percent = 100.0 * hits / static_cast<double>(errors.size());
  return result;
}

}  // namespace bench
