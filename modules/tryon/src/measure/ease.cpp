#include <bodice/tryon/ease.hpp>

#include <algorithm>

#include <Eigen/Geometry>

#include <bodice/engine/parallel.hpp>

namespace bodice::tryon {
namespace {

using geometry::Vec3;

constexpr std::size_t kTriangleGrain = 256;  // triangles a block: about a millisecond of closest points

/// One triangle of cloth.
struct Middle {
  double area_m2 = 0.0;  // zero: skipped
  double gap_m = 0.0, strain = 0.0;
  body::Part part = body::Part::kHead;
};

double longest_strain(const geometry::TriMesh& rest, std::span<const Vec3> now, const geometry::Triangle& t) {
  double strain = 0.0;
  for (int k = 0; k < 3; ++k) {
    const geometry::Index a = t[k], b = t[(k + 1) % 3];
    const double length_m = (rest.positions[a] - rest.positions[b]).norm();
    if (length_m > 0.0) strain = std::max(strain, (now[a] - now[b]).norm() / length_m - 1.0);
  }
  return strain;
}

/// The part of the vertex of the nearest triangle that is closest to the point.
body::Part part_at(const geometry::TriMesh& skin, std::span<const body::Part> part,
                   const geometry::SurfacePoint& at) {
  const geometry::Triangle& t = skin.triangles[at.triangle];
  return part[*std::ranges::min_element(
      t, {}, [&](geometry::Index v) { return (skin.positions[v] - at.point).squaredNorm(); })];
}

using Value = double Middle::*;

/// The least value that a share of the area does not exceed; sorts the triangles.
double quantile(std::vector<Middle>& middles, Value value, double share) {
  double total = 0.0, sum = 0.0;
  for (const Middle& m : middles) total += m.area_m2;
  std::ranges::sort(middles, {}, value);
  for (const Middle& m : middles)
    if ((sum += m.area_m2) >= share * total) return m.*value;
  return middles.back().*value;
}

PartEase summarize(body::Part part, std::vector<Middle>& middles) {
  PartEase ease{.part = part};
  for (const Middle& m : middles) ease.area_m2 += m.area_m2, ease.strain_mean += m.area_m2 * m.strain;
  ease.strain_mean /= ease.area_m2;
  ease.gap_median_m = quantile(middles, &Middle::gap_m, 0.5);
  ease.gap_p95_m = quantile(middles, &Middle::gap_m, 0.95);
  ease.strain_p95 = quantile(middles, &Middle::strain, 0.95);
  return ease;
}

}  // namespace

std::vector<PartEase> measure_ease(const engine::Context& context, const geometry::TriMesh& skin,
                                   std::span<const body::Part> part, const geometry::MeshDistance& distance,
                                   const geometry::TriMesh& rest, std::span<const Vec3> now) {
  std::vector<Middle> middles(rest.triangles.size());
  engine::parallel_for(context, middles.size(), kTriangleGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      const geometry::Triangle& corners = rest.triangles[t];
      const Vec3 &a = now[corners[0]], &b = now[corners[1]], &c = now[corners[2]];
      const Vec3 middle = (a + b + c) / 3.0;
      if (!middle.allFinite()) continue;
      const geometry::SurfacePoint below = distance.closest_point(middle);
      if (below.triangle == geometry::kNoIndex) continue;
      middles[t] = {0.5 * (b - a).cross(c - a).norm(), below.signed_distance,
                    longest_strain(rest, now, corners), part_at(skin, part, below)};
    }
  });
  std::vector<PartEase> eases;
  std::vector<Middle> on_part;
  for (int k = 0; k < body::kPartCount; ++k) {
    on_part.clear();
    for (const Middle& m : middles)
      if (m.area_m2 > 0.0 && m.part == static_cast<body::Part>(k)) on_part.push_back(m);
    if (!on_part.empty()) eases.push_back(summarize(static_cast<body::Part>(k), on_part));
  }
  return eases;
}

}  // namespace bodice::tryon
