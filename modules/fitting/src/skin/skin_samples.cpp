#include "skin/skin_samples.hpp"

#include <cmath>

#include <bodice/engine/parallel.hpp>
#include <bodice/engine/random.hpp>
#include <bodice/geometry/sampling.hpp>

#include "skin/buried_skin.hpp"

namespace bodice::inline v0_1::fitting {
namespace {

constexpr std::size_t kNormalGrain = 256;

/// Even samples of the wanted parts' skin that is not buried.
std::vector<geometry::SurfaceSample> wanted_skin(const SkinSource& source, std::size_t count,
                                                 std::uint64_t seed) {
  const LabeledSkin& skin = source.skin;
  auto samples = geometry::sample_surface(skin.mesh, count, seed);
  std::erase_if(samples, [&](const geometry::SurfaceSample& s) {
    const auto part = static_cast<int>(skin.part[skin.mesh.triangles[s.triangle][0]]);
    return ((source.parts >> part) & 1u) == 0 || source.buried[s.triangle];
  });
  return samples;
}

/// The signed distance of a point that was moved off the skin by `offset`, so that it is at most |offset|.
/// Where other skin is nearer, its normal decides the sign, or the winding number at sharp edges and next to
/// buried skin.
double exact_distance(const SkinSource& source, const Vec3& point, double offset) {
  const geometry::MeshDistance& distance = *source.skin.distance;
  const auto hit = distance.closest_point_within(point, std::abs(offset) * (1.0 + 1e-9));
  if (!hit) return offset;
  const double d = std::abs(hit->signed_distance);
  if (d >= std::abs(offset) * (1.0 - 1e-6)) return offset;
  const double side = hit->normal.dot(point - hit->point);
  if (!source.buried[hit->triangle] && std::abs(side) > 0.7 * d) return side < 0.0 ? -d : d;
  return distance.inside(point) ? -d : d;
}

/// Whether the closest point of the skin, |d| away, belongs to a part that is not wanted. Such a sample must
/// not attract ellipsoids.
bool is_of_others(const SkinSource& source, const Vec3& point, double d) {
  if (source.parts == kAllParts) return false;
  const auto hit = source.skin.distance->closest_point_within(point, std::abs(d) * (1.0 + 1e-6));
  if (!hit) return false;
  const auto part = static_cast<int>(source.skin.part[source.skin.mesh.triangles[hit->triangle][0]]);
  return ((source.parts >> part) & 1u) == 0;
}

/// The radius of the largest ball that touches the skin at p, from `radius` down.
double shrink_ball(const geometry::MeshDistance& distance, const Vec3& p, const Vec3& inward, double radius) {
  constexpr int kSteps = 12;
  for (int step = 0; step < kSteps; ++step) {
    const auto hit = distance.closest_point_within(p + radius * inward, radius * (1.0 - 1e-3));
    if (!hit) break;
    const Vec3 to = hit->point - p;
    const double along = 2.0 * inward.dot(to);
    const double next = along > 0.0 ? to.squaredNorm() / along : 0.0;
    if (!(next > 0.0 && next < radius)) break;
    radius = next;
  }
  return radius;
}

}  // namespace

SkinSource make_skin_source(const engine::Context& context, const LabeledSkin& skin, std::uint32_t parts) {
  std::uint32_t torso = 0;
  for (int p = 0; p < body::kAllPartCount; ++p)
    if (body::is_torso(static_cast<body::Part>(p))) torso |= 1u << p;
  if (parts & torso) parts |= torso;
  return {skin, parts, buried_triangles(context, skin.mesh, *skin.distance, skin.stature_m)};
}

std::vector<DistanceSample> sample_near_skin(const engine::Context& context, const SkinSource& source,
                                             const SampleOptions& options) {
  const LabeledSkin& skin = source.skin;
  const auto surface = wanted_skin(source, options.count, options.seed);
  std::vector<DistanceSample> samples(surface.size());
  const engine::Random random(options.seed, 17);
  engine::parallel_for(context, surface.size(), kNormalGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t t = surface[i].triangle;
      const Vec3 normal = geometry::area_vector(skin.mesh, t).stableNormalized();
      const double kind = random.uniform_at(2 * i), u = random.uniform_at(2 * i + 1);
      const bool on_skin = kind < options.on_skin;
      double offset = on_skin ? 0.0 : (options.outward_m + options.inward_m) * u - options.inward_m;
      if (kind >= 1.0 - options.far) offset = options.outward_m + (options.far_m - options.outward_m) * u;
      const Vec3 p = surface[i].point + offset * normal;
      const double d = on_skin ? 0.0 : exact_distance(source, p, offset);
      const bool one_sided = !on_skin && is_of_others(source, p, d);
      samples[i] = {p, d, skin.part[skin.mesh.triangles[t][0]], one_sided};
    }
  });
  return samples;
}

std::vector<InscribedBall> inscribed_balls(const engine::Context& context, const SkinSource& source,
                                           std::size_t count, std::uint64_t seed) {
  const LabeledSkin& skin = source.skin;
  const auto surface = wanted_skin(source, count, seed);
  std::vector<InscribedBall> balls(surface.size());
  engine::parallel_for(context, surface.size(), kNormalGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t t = surface[i].triangle;
      const Vec3 inward = -geometry::area_vector(skin.mesh, t).stableNormalized();
      // No cross-section of a body is thicker than a third of its height.
      const double r = shrink_ball(*skin.distance, surface[i].point, inward, 0.15 * skin.stature_m);
      balls[i] = {surface[i].point + r * inward, surface[i].point, r, skin.part[skin.mesh.triangles[t][0]]};
    }
  });
  return balls;
}

}  // namespace bodice::fitting
