#include <bodice/tryon/judge_frame.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <bodice/engine/parallel.hpp>
#include <bodice/geometry/sampling.hpp>

namespace bodice::inline v0_1::tryon {
namespace {

using geometry::Vec3;

constexpr std::size_t kSamples = 4000;
constexpr std::uint64_t kSampleSeed = 17;
constexpr std::size_t kJudgeGrain = 64;
constexpr double kWrong_m = 1e-3;  // distance from the skin from which a wrong side counts as missed or false
constexpr double kOverlap = 1.5;   // a winding number above this means two layers of the body
constexpr double kOver_m = 3e-4;   // height above the skin at which a layer over it is searched for
constexpr double kSpacing_m = 4e-3;                  // distance of samples on the cloth
constexpr double kGoldenRatio = 0.6180339887498949;  // spreads consecutive offsets evenly

struct Sample {
  double truth_m = std::numeric_limits<double>::quiet_NaN();
  double proxy_m = 0.0;
};

/// Offsets from -1 to 1 that are spread evenly over any run of consecutive samples.
double offset_of(std::size_t sample) {
  const double turns = kGoldenRatio * static_cast<double>(sample + 1);
  return 2.0 * (turns - std::floor(turns)) - 1.0;
}

double collider_distance_m(const collision::Collider& collider, const Vec3& world) {
  const Eigen::Vector3f p = (world - collider.origin()).cast<float>();
  return double{collider.query({p.x(), p.y(), p.z()}).signed_distance};
}

ProxyError summarize(const std::vector<Sample>& samples) {
  ProxyError result;
  std::vector<double> errors;
  std::size_t missed = 0, false_hits = 0;
  for (const Sample& s : samples) {
    if (!std::isfinite(s.truth_m)) continue;
    errors.push_back(std::abs(s.proxy_m - s.truth_m));
    missed += s.truth_m < -kWrong_m && s.proxy_m > 0.0;
    false_hits += s.truth_m > kWrong_m && s.proxy_m < 0.0;
  }
  if (errors.empty()) return result;
  std::ranges::sort(errors);
  const auto count = static_cast<double>(errors.size());
  for (const double e : errors) result.error_m.mean += e / count;
  result.error_m.p95 = errors[static_cast<std::size_t>(0.95 * (count - 1.0))];
  result.error_m.max = errors.back();
  result.missed_share = static_cast<double>(missed) / count;
  result.false_share = static_cast<double>(false_hits) / count;
  result.samples = errors.size();
  return result;
}

/// A triangle of cloth. It is split into equal triangles, and their centers are its samples.
struct SampledTriangle {
  Vec3 a, b, c;
  double area_m2 = 0.0, longest_m = 0.0;

  int splits() const { return std::max(1, static_cast<int>(std::ceil(longest_m / kSpacing_m))); }

  /// Calls visit(point, area) for each sample, with the area that it represents. Rows alternate in direction,
  /// so that each sample lies beside the one before.
  template <class Visit>
  void for_each_sample(Visit&& visit) const {
    const int n = splits();
    const double each_m2 = area_m2 / (static_cast<double>(n) * n);
    for (int i = 0; i < n; ++i) {
      const int in_row = 2 * (n - i) - 1;
      for (int k = 0; k < in_row; ++k) {
        const int along = i % 2 == 0 ? k : in_row - 1 - k;
        const int j = along / 2, down = along % 2;
        const double u = (i + (1.0 + down) / 3.0) / n, v = (j + (1.0 + down) / 3.0) / n;
        visit(Vec3((1.0 - u - v) * a + u * b + v * c), each_m2);
      }
    }
  }
};

SampledTriangle sampled_triangle(std::span<const Vec3> positions, const geometry::Triangle& t) {
  SampledTriangle sampled{positions[t[0]], positions[t[1]], positions[t[2]]};
  sampled.area_m2 = 0.5 * (sampled.b - sampled.a).cross(sampled.c - sampled.a).norm();
  sampled.longest_m = std::max(
      {(sampled.b - sampled.a).norm(), (sampled.c - sampled.b).norm(), (sampled.a - sampled.c).norm()});
  return sampled;
}

}  // namespace

bool is_overlapped(const geometry::MeshDistance& distance, const Vec3& point,
                   const geometry::SurfacePoint& nearest) {
  return distance.winds_more_than(kOverlap, point) ||
         distance.inside(nearest.point + kOver_m * nearest.normal);
}

ProxyError measure_proxy_error(const engine::Context& context, const collision::Collider& collider,
                               const geometry::TriMesh& skin, const geometry::MeshDistance& distance,
                               double within_m) {
  const std::vector<geometry::SurfaceSample> on_skin = geometry::sample_surface(skin, kSamples, kSampleSeed);
  std::vector<Sample> samples(on_skin.size());
  engine::parallel_for(context, samples.size(), kJudgeGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3 normal = geometry::area_vector(skin, on_skin[i].triangle).stableNormalized();
      const Vec3 point = on_skin[i].point + within_m * offset_of(i) * normal;
      const geometry::SurfacePoint nearest = distance.closest_point(point);
      if (!(std::abs(nearest.signed_distance) <= within_m) || is_overlapped(distance, point, nearest))
        continue;
      samples[i] = {nearest.signed_distance, collider_distance_m(collider, point)};
    }
  });
  return summarize(samples);
}

void for_each_inside(const geometry::MeshDistance& skin, geometry::DistanceWalk& walk,
                     std::span<const Vec3> positions, const geometry::Triangle& triangle, double depth_m,
                     const std::function<void(const InsidePoint&)>& visit) {
  const SampledTriangle sampled = sampled_triangle(positions, triangle);
  if (!(sampled.area_m2 > 0.0) || !std::isfinite(sampled.area_m2)) return;
  // A signed distance changes by no more than its point moves, so that one query excludes most triangles.
  if (walk.closest_point((sampled.a + sampled.b + sampled.c) / 3.0).signed_distance > sampled.longest_m)
    return;
  sampled.for_each_sample([&](const Vec3& at, double area_m2) {
    if (walk.least_distance_m(at) > -depth_m) return;
    const geometry::SurfacePoint nearest = walk.closest_point(at);
    if (nearest.signed_distance < -depth_m)
      visit({at, area_m2, -nearest.signed_distance, is_overlapped(skin, at, nearest)});
  });
}

ClothInside cloth_inside(const engine::Context& context, const geometry::MeshDistance& skin,
                         std::span<const Vec3> positions, std::span<const geometry::Triangle> triangles,
                         double depth_m) {
  return engine::ordered_reduce(
      context, triangles.size(), kJudgeGrain, ClothInside{},
      [&](std::size_t begin, std::size_t end) {
        ClothInside sum;
        geometry::DistanceWalk walk(skin);
        for (std::size_t t = begin; t < end; ++t)
          for_each_inside(skin, walk, positions, triangles[t], depth_m, [&](const InsidePoint& point) {
            (point.is_overlapped ? sum.overlapped_m2 : sum.shown_m2) += point.area_m2;
          });
        return sum;
      },
      [](const ClothInside& a, const ClothInside& b) {
        return ClothInside{a.shown_m2 + b.shown_m2, a.overlapped_m2 + b.overlapped_m2};
      });
}

}  // namespace bodice::tryon
