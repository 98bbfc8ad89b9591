// Points on a small integer grid, which has many ties and flat sets: enclosing ellipsoids and clusters.
#include <algorithm>
#include <cmath>
#include <vector>

#include <bodice/fitting/kmeans.hpp>
#include <bodice/fitting/mvee.hpp>

#include "harness.hpp"

using namespace bodice;
using geometry::Vec3;

namespace {

/// Points of an 8 x 8 x 8 grid; the first byte's low bits choose scale and offset.
std::vector<Vec3> points_of(fuzz::Bytes& in) {
  const std::uint8_t kind = in.next();
  const double scale = std::pow(10.0, 3 * (kind % 5) - 6);
  const Vec3 offset = kind & 0x80 ? Vec3(1e4 * scale, -1e4 * scale, 3e3 * scale) : Vec3(Vec3::Zero());
  std::vector<Vec3> points;
  while (!in.rest().empty() && points.size() < 200) {
    const int a = in.next(), b = in.next();
    points.push_back(offset + scale * Vec3(a & 7, (a >> 3) & 7, b & 7));
  }
  return points;
}

double size_of(const std::vector<Vec3>& points) {
  return geometry::bounding_box(points).size().norm();
}

void check_encloses(const fitting::Mvee& found, const std::vector<Vec3>& points) {
  FUZZ_CHECK(found.ellipsoid.center.allFinite() && found.ellipsoid.radii.allFinite());
  const auto box = geometry::bounding_box(points);
  const double tolerance = 1e-7 * size_of(points) + 1e-14 * (box.empty() ? 0.0 : box.center().norm());
  for (const Vec3& p : points)
    FUZZ_CHECK(geometry::closest_point(found.ellipsoid, p).signed_distance <= tolerance);
}

}  // namespace

FUZZ_TARGET(points) {
  fuzz::Bytes in(data, size);
  const std::vector<Vec3> points = points_of(in);
  const auto exact = fitting::mvee(points);
  check_encloses(exact, points);
  // Far away, the rounding of coordinates is a part of a thin set's thickness, which the certificate
  // includes.
  FUZZ_CHECK(exact.volume_gap <=
             (!points.empty() && points[0].norm() > 100.0 * size_of(points) ? 1e-2 : 1e-6));
  check_encloses(fitting::mvee_first_order(points, 1e-2), points);
  if (points.empty()) return 0;
  const std::vector<Vec3> centers(
      points.begin(), points.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(5, points.size())));
  const auto clusters = fitting::kmeans({}, points, {}, centers, {});
  FUZZ_CHECK(clusters.of_point.size() == points.size());
  for (const auto cluster : clusters.of_point) FUZZ_CHECK(cluster < clusters.centers.size());
  for (const Vec3& center : clusters.centers) FUZZ_CHECK(center.allFinite());
  return 0;
}
