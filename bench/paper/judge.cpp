#include "judge.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <bodice/engine/random.hpp>
#include <bodice/geometry/sampling.hpp>

namespace paper_bench {

using bodice::geometry::Ellipsoid;
using bodice::geometry::Vec3;

namespace {

constexpr double kDeep_m = 0.010;
constexpr double kOn_m = 1e-6;  // a point this near to a surface lies on it

/// The signed distance to the union: exact outside of it, some negative number inside.
double distance_to(std::span<const Ellipsoid> ellipsoids, const Vec3& p) {
  double least = 1e30;
  for (const Ellipsoid& e : ellipsoids) {
    // The enclosing ball is no farther than the ellipsoid, so that it rules out most ellipsoids.
    const double reach = (p - e.center).norm() - e.radii.maxCoeff();
    if (reach < least) least = std::min(least, bodice::geometry::closest_point(e, p).signed_distance);
  }
  return least;
}

double percent(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0.0 : 100.0 * static_cast<double>(part) / static_cast<double>(whole);
}

/// The distance to the skin of a point of the union's surface, and the area that the point represents.
struct Gap {
  double gap_m, area;
};

/// Adds the gaps of the part of ellipsoid k's surface that no other ellipsoid covers, at Fibonacci
/// directions.
void add_gaps(std::span<const Ellipsoid> ellipsoids, std::size_t k,
              const bodice::geometry::MeshDistance& distance, int count, std::vector<Gap>& gaps) {
  const Ellipsoid& e = ellipsoids[k];
  const double golden = std::numbers::pi * (3.0 - std::sqrt(5.0));
  for (int i = 0; i < count; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / count, ring = std::sqrt(1.0 - z * z);
    const Vec3 u(ring * std::cos(golden * i), ring * std::sin(golden * i), z);
    const Vec3 p = e.center + e.axes * e.radii.cwiseProduct(u);
    if (distance_to(ellipsoids, p) < -kOn_m) continue;
    const auto hit = distance.closest_point_within(p, 10.0);
    if (hit)
      gaps.push_back(
          {std::abs(hit->signed_distance), e.radii.prod() * u.cwiseQuotient(e.radii).norm() / count});
  }
}

void set_gaps(std::vector<Gap> gaps, Approximation& a) {
  std::ranges::sort(gaps, {}, &Gap::gap_m);
  double area = 0.0, sum = 0.0, running = 0.0;
  for (const Gap& g : gaps) area += g.area, sum += g.area * g.gap_m;
  for (const Gap& g : gaps) {
    running += g.area;
    a.gap_p95_mm = 1e3 * g.gap_m;
    if (running >= 0.95 * area) break;
  }
  a.gap_mean_mm = area > 0.0 ? 1e3 * sum / area : 0.0;
}

void set_radial(std::span<const Ellipsoid> ellipsoids, std::span<const Vec3> vertices, Approximation& a) {
  std::vector<double> sum(ellipsoids.size(), 0.0), count(ellipsoids.size(), 0.0);
  for (const Vec3& p : vertices) {
    double least = 1e30;
    std::size_t owner = 0;
    for (std::size_t k = 0; k < ellipsoids.size(); ++k) {
      const double d = (p - bodice::geometry::radial_projection(ellipsoids[k], p)).norm();
      if (d < least) least = d, owner = k;
    }
    sum[owner] += least;
    count[owner] += 1.0;
  }
  double owners = 0.0;
  for (std::size_t k = 0; k < ellipsoids.size(); ++k) {
    if (count[k] == 0.0) continue;
    owners += 1.0;
    a.radial_mean_mm += 1e3 * sum[k] / count[k];
    a.radial_worst_mm = std::max(a.radial_worst_mm, 1e3 * sum[k] / count[k]);
  }
  if (owners > 0.0) a.radial_mean_mm /= owners;
}

}  // namespace

Judge::Judge(const bodice::engine::Context& context, const bodice::geometry::TriMesh& mesh,
             std::size_t samples)
    : distance_(context, mesh), vertices_(mesh.positions), samples_(samples) {
  for (const auto& s : bodice::geometry::sample_surface(mesh, samples, 1)) skin_.push_back(s.point);
  const auto box = bodice::geometry::bounding_box(mesh.positions);
  bodice::engine::Random random(1, 2);
  // A standing body fills 3 to 15 % of its box; the bound only guards against a mesh without an inside.
  for (std::size_t i = 0; i < 1000 * samples && interior_.size() < samples; ++i) {
    Vec3 p;
    for (int axis = 0; axis < 3; ++axis) p[axis] = random.uniform(box.low[axis], box.high[axis]);
    if (!distance_.inside(p)) continue;
    interior_.push_back(p);
    if (!distance_.closest_point_within(p, kDeep_m)) deep_.push_back(p);
  }
}

Approximation Judge::judge(std::span<const Ellipsoid> ellipsoids) const {
  Approximation a;
  std::vector<Gap> gaps;
  const int each = static_cast<int>(samples_ / std::max<std::size_t>(1, ellipsoids.size())) + 24;
  for (std::size_t k = 0; k < ellipsoids.size(); ++k) add_gaps(ellipsoids, k, distance_, each, gaps);
  set_gaps(std::move(gaps), a);
  if (!ellipsoids.empty()) set_radial(ellipsoids, vertices_, a);
  std::size_t outside = 0;
  for (const Vec3& p : skin_) {
    const double d = distance_to(ellipsoids, p);
    if (d <= kOn_m) continue;
    ++outside;
    a.outside_mm = std::max(a.outside_mm, 1e3 * d);
  }
  a.outside_percent = percent(outside, skin_.size());
  const auto held = [&](const Vec3& p) {
    return std::ranges::any_of(ellipsoids,
                               [&](const Ellipsoid& e) { return bodice::geometry::level(e, p) <= 1.0; });
  };
  a.interior_percent =
      percent(static_cast<std::size_t>(std::ranges::count_if(interior_, held)), interior_.size());
  a.leak_percent =
      percent(deep_.size() - static_cast<std::size_t>(std::ranges::count_if(deep_, held)), deep_.size());
  return a;
}

}  // namespace paper_bench
