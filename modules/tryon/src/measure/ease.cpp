#include <bodice/tryon/ease.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>

#include <bodice/engine/parallel.hpp>
#include <bodice/geometry/decompositions.hpp>

#include "measure/triangle_strain.hpp"

namespace bodice::inline v0_1::tryon {
namespace {

using geometry::Vec3;

constexpr std::size_t kTriangleGrain = 256;  // triangles a block: about a millisecond of closest points

/// The ease of one triangle of cloth, at its centroid.
struct TriangleEase {
  double area_m2 = 0.0;  // zero: skipped
  double gap_m = 0.0, strain = 0.0;
  body::Part part = body::Part::kHead;
};

/// The part of the closest point's triangle: that of the corner nearest to the point.
body::Part part_at(const geometry::TriMesh& skin, std::span<const body::Part> part,
                   const geometry::SurfacePoint& at) {
  const geometry::Triangle& t = skin.triangles[at.triangle];
  return part[*std::ranges::min_element(
      t, {}, [&](geometry::Index v) { return (skin.positions[v] - at.point).squaredNorm(); })];
}

/// Moments of the skin of a limb part, or of a whole ring of the torso, by area.
struct SkinMoments {
  double area_m2 = 0.0;
  Vec3 moment = Vec3::Zero();
  geometry::Mat3 second = geometry::Mat3::Zero(), normals = geometry::Mat3::Zero();

  void add(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 middle = (a + b + c) / 3.0, normal = 0.5 * (b - a).cross(c - a);
    const double own_m2 = normal.norm();
    if (!(own_m2 > 0.0)) return;
    area_m2 += own_m2, moment += own_m2 * middle, second += own_m2 * middle * middle.transpose();
    normals += normal * normal.transpose() / own_m2;
  }
  /// The mean girth, which is area over length. The axis of a tube is the direction with the least normal
  /// component. Along it, a tube of length L has the variance L^2 / 12.
  double girth_m() const {
    if (!(area_m2 > 0.0)) return 0.0;
    const Vec3 axis = geometry::eigen_of_symmetric(normals).vectors.col(0);
    const double mean = axis.dot(moment) / area_m2;
    const double variance = axis.dot(second * axis) / area_m2 - mean * mean;
    return variance > 0.0 ? area_m2 / std::sqrt(12.0 * variance) : 0.0;
  }
};

/// The mean girth of each part. Both halves of a ring of the torso have that of the whole ring.
std::array<double, body::kAllPartCount> girths_of(const geometry::TriMesh& skin,
                                                  std::span<const body::Part> part) {
  const auto whole = [](body::Part p) { return body::is_torso(p) ? std::min(p, body::mirrored(p)) : p; };
  std::array<SkinMoments, body::kAllPartCount> moments;
  for (const geometry::Triangle& t : skin.triangles)
    moments[static_cast<std::size_t>(whole(part[t[0]]))].add(skin.positions[t[0]], skin.positions[t[1]],
                                                             skin.positions[t[2]]);
  std::array<double, body::kAllPartCount> girths{};
  for (std::size_t p = 0; p < girths.size(); ++p)
    girths[p] = moments[static_cast<std::size_t>(whole(static_cast<body::Part>(p)))].girth_m();
  return girths;
}

using Value = double TriangleEase::*;

/// The quantile of a value by area: triangles with at most this value have `share` of the area. Sorts the
/// triangles.
double quantile(std::vector<TriangleEase>& triangles, Value value, double share) {
  double total = 0.0, sum = 0.0;
  for (const TriangleEase& m : triangles) total += m.area_m2;
  std::ranges::sort(triangles, {}, value);
  for (const TriangleEase& m : triangles)
    if ((sum += m.area_m2) >= share * total) return m.*value;
  return triangles.back().*value;
}

PartEase summarize(body::Part part, std::vector<TriangleEase>& triangles) {
  PartEase ease{.part = part};
  for (const TriangleEase& m : triangles) ease.area_m2 += m.area_m2, ease.strain_mean += m.area_m2 * m.strain;
  ease.strain_mean /= ease.area_m2;
  ease.gap_median_m = quantile(triangles, &TriangleEase::gap_m, 0.5);
  ease.gap_p95_m = quantile(triangles, &TriangleEase::gap_m, 0.95);
  ease.strain_p95 = quantile(triangles, &TriangleEase::strain, 0.95);
  return ease;
}

}  // namespace

std::vector<PartEase> measure_ease(const engine::Context& context, const geometry::TriMesh& skin,
                                   std::span<const body::Part> part, const geometry::MeshDistance& distance,
                                   const geometry::TriMesh& rest, std::span<const Vec3> now) {
  std::vector<TriangleEase> triangles(rest.triangles.size());
  engine::parallel_for(context, triangles.size(), kTriangleGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      const geometry::Triangle& corners = rest.triangles[t];
      const Vec3 &a = now[corners[0]], &b = now[corners[1]], &c = now[corners[2]];
      const Vec3 middle = (a + b + c) / 3.0;
      if (!middle.allFinite()) continue;
      const geometry::SurfacePoint below = distance.closest_point(middle);
      if (below.triangle == geometry::kNoIndex) continue;
      triangles[t] = {0.5 * (b - a).cross(c - a).norm(), below.signed_distance,
                      longest_strain(rest, now, corners), part_at(skin, part, below)};
    }
  });
  const std::array<double, body::kAllPartCount> girths = girths_of(skin, part);
  std::vector<PartEase> eases;
  std::vector<TriangleEase> on_part;
  for (int k = 0; k < body::kAllPartCount; ++k) {
    on_part.clear();
    for (const TriangleEase& m : triangles)
      if (m.area_m2 > 0.0 && m.part == static_cast<body::Part>(k)) on_part.push_back(m);
    if (on_part.empty()) continue;
    eases.push_back(summarize(static_cast<body::Part>(k), on_part));
    eases.back().girth_m = girths[static_cast<std::size_t>(k)];
  }
  return eases;
}

}  // namespace bodice::tryon
