#include "relief/relief_samples.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <bodice/engine/parallel.hpp>
#include <bodice/engine/random.hpp>
#include <bodice/geometry/sampling.hpp>

#include "base/interior_grid.hpp"

namespace bodice::inline v0_1::fitting {
namespace {

constexpr double kTouch =
    1e-4;  // fraction of a radius: the point that a ball touches does not count as inside it

/// How far along `direction` the skin point p is certainly the closest point of the skin, at most `reach_m`:
/// the radius of a ball that touches p and holds no skin, because every smaller ball there is empty as well.
/// It is found by shrinking balls (skin_samples.hpp); 0 if three tries do not suffice.
double free_reach(const FreeSkin& skin, const Vec3& p, const Vec3& direction, double reach_m) {
  constexpr int kTries = 3;
  double radius = reach_m;
  for (int attempt = 0; attempt < kTries; ++attempt) {
    const auto hit = skin.closest_point_within(p + radius * direction, radius * (1.0 - kTouch));
    if (!hit) return radius;
    const Vec3 to = hit->point - p;
    const double along = 2.0 * direction.dot(to);
    const double next = along > 0.0 ? (1.0 - 10.0 * kTouch) * to.squaredNorm() / along : 0.0;
    if (!(next > 0.0 && next < radius)) return 0.0;
    radius = next;
  }
  return 0.0;
}

/// The signed distance of a point, at most `reach_m`. The triangle's normal decides the sign where it can,
/// the winding number at sharp edges and far away.
double signed_distance(const FreeSkin& skin, const Vec3& point, double reach_m) {
  const auto hit = skin.closest_point_within(point, reach_m * (1.0 + kTouch));
  if (!hit) return skin.inside(point) ? -reach_m : reach_m;
  const double d = std::abs(hit->signed_distance), side = hit->normal.dot(point - hit->point);
  // Next to a cut the closest point may lie on the rim, where the triangle's normal decides nothing.
  if (std::abs(side) > (skin.is_cut() ? 0.9999 : 0.7) * d) return side < 0.0 ? -d : d;
  return skin.inside(point) ? -d : d;
}

/// The weight of a sample: on the skin, where a wrong sign is a missed or a false contact, twice that far
/// away.
float importance(double s, double reach_m) {
  return static_cast<float>(1.0 + std::exp(-std::abs(s) / (0.2 * reach_m)));
}

/// The samples without those of weight zero.
std::vector<ReliefSample> with_weight(std::vector<ReliefSample> samples) {
  std::erase_if(samples, [](const ReliefSample& s) { return !(s.weight > 0.0f); });
  return samples;
}

}  // namespace

std::vector<ReliefSample> sample_along_normals(const engine::Context& context, const FreeSkin& skin,
                                               const ReliefSampling& sampling) {
  const geometry::TriMesh& mesh = skin.all().mesh;
  const auto surface = geometry::sample_surface(mesh, sampling.normals, sampling.seed);
  const auto each = static_cast<std::size_t>(sampling.per_normal);
  const double reach = sampling.reach_m;
  const engine::Random random(sampling.seed, 17);
  std::vector<ReliefSample> samples(surface.size() * each);
  engine::parallel_for(context, surface.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t t = surface[i].triangle;
      if (!skin.bounds(t) || !skin.wanted(skin.all().part[mesh.triangles[t][0]])) continue;
      const Vec3 normal = geometry::area_vector(mesh, t).stableNormalized();
      // A point of a triangle that dips into another limb may itself be buried, so that nothing is certain
      // about it.
      const bool open = skin.is_open(t);
      const double outward = open ? free_reach(skin, surface[i].point, normal, reach) : -reach;
      const double inward = open ? free_reach(skin, surface[i].point, -normal, reach) : -reach;
      for (std::size_t j = 0; j < each; ++j) {
        const double stretch = static_cast<double>(j) + random.uniform_at(i * each + j);
        const double offset = reach * (2.0 * stretch / static_cast<double>(each) - 1.0);
        const Vec3 point = surface[i].point + offset * normal;
        const bool free = offset <= outward && offset >= -inward;
        const double s = free ? offset : signed_distance(skin, point, reach);
        samples[i * each + j] = {point, s, importance(s, reach)};
      }
    }
  });
  return with_weight(std::move(samples));
}

std::vector<ReliefSample> sample_inside(const engine::Context& context, const FreeSkin& skin,
                                        double spacing_m, double reach_m) {
  const std::vector<Vec3> grid = interior_grid(skin.all().mesh, spacing_m);
  std::vector<ReliefSample> samples(grid.size());
  engine::parallel_for(context, grid.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto hit = skin.closest_point_within(grid[i], skin.all().stature_m);
      if (!hit || !skin.wanted(skin.part(*hit))) continue;
      const double s = -std::min(std::abs(hit->signed_distance), reach_m);
      samples[i] = {grid[i], s, importance(s, reach_m)};
    }
  });
  return with_weight(std::move(samples));
}

std::vector<ReliefSample> sample_around(const engine::Context& context, const FreeSkin& skin,
                                        std::span<const Vec3> points, double radius_m, double reach_m) {
  constexpr std::size_t kEach = 48;
  const engine::Random random(23);
  std::vector<ReliefSample> samples(points.size() * kEach);
  engine::parallel_for(context, samples.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3 u(random.uniform_at(3 * i), random.uniform_at(3 * i + 1), random.uniform_at(3 * i + 2));
      const double reach = i % kEach == 0 ? 0.0 : radius_m;  // the first sample is the given point itself
      const Vec3 point = points[i / kEach] + reach * (2.0 * u - Vec3::Ones());
      const double s = signed_distance(skin, point, reach_m);
      samples[i] = {point, s, 0.25f * importance(s, reach_m)};
    }
  });
  return samples;
}

}  // namespace bodice::fitting
