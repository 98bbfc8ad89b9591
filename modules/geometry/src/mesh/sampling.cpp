// Based on: Robert Osada, Thomas Funkhouser, Bernard Chazelle, David Dobkin. Shape Distributions. 2002. - eq.
// (1)
// Differs: areas are stratified, and a low-discrepancy sequence replaces three independent random numbers.
#include <bodice/geometry/sampling.hpp>

#include <algorithm>
#include <cmath>

#include <bodice/engine/random.hpp>

namespace bodice::inline v0_1::geometry {
namespace {

// The R2 sequence's steps: powers of the inverse plastic number.
constexpr double kR2X = 0.7548776662466927;
constexpr double kR2Y = 0.5698402909980532;

double fraction(double x) {
  return x - std::floor(x);
}

/// A point of the triangle, uniform if (u, v) is uniform over the unit square.
Vec3 point_in_triangle(const TriMesh& mesh, Index triangle, double u, double v) {
  const double root = std::sqrt(u);
  const Vec3& a = mesh.corner(triangle, 0);
  return a + (root * (1.0 - v)) * (mesh.corner(triangle, 1) - a) +
         (root * v) * (mesh.corner(triangle, 2) - a);
}

}  // namespace

std::vector<SurfaceSample> sample_surface(const TriMesh& mesh, std::size_t count, std::uint64_t seed) {
  std::vector<double> area_below(mesh.triangles.size() + 1, 0.0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const double area = 0.5 * area_vector(mesh, t).norm();
    area_below[t + 1] = area_below[t] + (std::isfinite(area) ? area : 0.0);
  }
  const double total = area_below.back();
  std::vector<SurfaceSample> samples;
  if (!(total > 0.0)) return samples;
  samples.reserve(count);
  engine::Random random(seed);
  const double shift_u = random.uniform();
  const double shift_v = random.uniform();
  const double stratum = total / static_cast<double>(count);
  std::size_t triangle = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const auto index = static_cast<double>(i);
    const double at = (index + random.uniform()) * stratum;
    while (triangle + 1 < mesh.triangles.size() && area_below[triangle + 1] <= at) ++triangle;
    const auto t = static_cast<Index>(triangle);
    const Vec3 point =
        point_in_triangle(mesh, t, fraction(shift_u + index * kR2X), fraction(shift_v + index * kR2Y));
    samples.push_back({point, t, stratum});
  }
  return samples;
}

}  // namespace bodice::geometry
