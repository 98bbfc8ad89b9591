#include "bind/owned_skin.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include <bodice/engine/parallel.hpp>

namespace bodice::inline v0_1::binding {
namespace {

constexpr std::size_t kMostVertices = 16384;
constexpr std::size_t kGrain = 64;

double outside_sphere(const geometry::Ellipsoid& e, const Vec3& point) {
  return (point - e.center).norm() - e.radii.maxCoeff();
}

std::vector<double> vertex_areas(const geometry::TriMesh& skin) {
  std::vector<double> area(skin.positions.size(), 0.0);
  for (std::size_t t = 0; t < skin.triangles.size(); ++t) {
    const double third = geometry::area_vector(skin, t).norm() / 3.0;
    for (const geometry::Index v : skin.triangles[t]) area[v] += third;
  }
  return area;
}

using Near = std::vector<std::pair<std::uint32_t, double>>;

/// The ellipsoids within the band of the nearest one, with what they are farther.
Near near_ellipsoids(std::span<const proxy::ProxyEllipsoid> ellipsoids, const Vec3& point, double band_m) {
  const double least = nearest_distance(ellipsoids, point);
  Near near;
  for (std::uint32_t k = 0; k < ellipsoids.size(); ++k) {
    if (outside_sphere(ellipsoids[k].shape, point) >= least + band_m) continue;
    const double excess = geometry::closest_point(ellipsoids[k].shape, point).signed_distance - least;
    if (excess < band_m) near.emplace_back(k, excess);
  }
  return near;
}

std::uint32_t nearest_vertex(const geometry::TriMesh& skin, const Vec3& point) {
  const auto squared = [&](const Vec3& a, const Vec3& b) {
    return (a - point).squaredNorm() < (b - point).squaredNorm();
  };
  const auto found = std::ranges::min_element(skin.positions, squared);
  return static_cast<std::uint32_t>(found - skin.positions.begin());
}

}  // namespace

double nearest_distance(std::span<const proxy::ProxyEllipsoid> ellipsoids, const Vec3& point) {
  double least = std::numeric_limits<double>::infinity();
  for (const proxy::ProxyEllipsoid& e : ellipsoids)
    if (outside_sphere(e.shape, point) < least)
      least = std::min(least, geometry::closest_point(e.shape, point).signed_distance);
  return least;
}

std::vector<std::vector<OwnedVertex>> owned_skin(const engine::Context& context,
                                                 std::span<const proxy::ProxyEllipsoid> ellipsoids,
                                                 const geometry::TriMesh& skin, double band_m) {
  const std::size_t vertices = skin.positions.size();
  const std::size_t step = std::max<std::size_t>(1, vertices / kMostVertices);
  std::vector<Near> near((vertices + step - 1) / step);
  engine::parallel_for(context, near.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      near[i] = near_ellipsoids(ellipsoids, skin.positions[i * step], band_m);
  });
  const std::vector<double> area = vertex_areas(skin);
  std::vector<std::vector<OwnedVertex>> owned(ellipsoids.size());
  for (std::size_t i = 0; i < near.size(); ++i)
    for (const auto& [k, excess] : near[i]) {
      const double ramp = 1.0 - excess / band_m;
      const double weight = ramp * ramp * area[i * step];
      if (weight > 0.0) owned[k].push_back({static_cast<std::uint32_t>(i * step), weight});
    }
  for (std::size_t k = 0; k < owned.size(); ++k)
    if (owned[k].empty()) owned[k].push_back({nearest_vertex(skin, ellipsoids[k].shape.center), 1.0});
  return owned;
}

}  // namespace bodice::binding
