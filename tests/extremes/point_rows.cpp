#include <algorithm>
#include <cmath>

#include <bodice/fitting/kmeans.hpp>
#include <bodice/fitting/mvee.hpp>
#include <bodice_test/extremes.hpp>

#include "rows.hpp"

namespace extremes {
namespace {

using namespace bodice;
using bodice_test::PointSetCase;
using geometry::Vec3;

/// The resolution of doubles at these coordinates.
double resolution_m(const PointSetCase& c) {
  return 1e-15 * (c.offset_m + c.size_m);
}

std::size_t not_finite(const PointSetCase& c) {
  return static_cast<std::size_t>(
      std::ranges::count_if(c.points, [](const Vec3& p) { return !p.allFinite(); }));
}

/// The distance of the farthest point outside, meters, by exact distance and not by the solver's own measure.
double outside_m(const geometry::Ellipsoid& e, const PointSetCase& c) {
  double worst = 0.0;
  for (const Vec3& p : c.points)
    if (p.allFinite()) worst = std::max(worst, geometry::closest_point(e, p).signed_distance);
  return worst;
}

std::string check_mvee(const PointSetCase& c, const fitting::Mvee& found, double most_gap) {
  const auto& e = found.ellipsoid;
  if (!e.center.allFinite() || !e.axes.allFinite() || !e.radii.allFinite()) return "not finite";
  if (!(e.radii.minCoeff() > 0.0) && c.dimension >= 0) return "a radius is not positive";
  if (found.skipped != not_finite(c)) return "skipped " + std::to_string(found.skipped);
  const double outside = outside_m(e, c);
  if (outside > 1e-7 * c.size_m + resolution_m(c)) return "a point is outside by " + std::to_string(outside);
  if (found.volume_gap > most_gap) return "volume gap " + std::to_string(found.volume_gap);
  // If rounding decides the dimension, any dimension is right.
  const bool rounding = c.offset_m > 1e3 * c.size_m || c.name.find("but for") != std::string::npos;
  return expect(rounding || found.rank == std::max(0, c.dimension),
                "rank " + std::to_string(found.rank) + " for dimension " + std::to_string(c.dimension));
}

std::string check_kmeans(const PointSetCase& c) {
  std::vector<Vec3> centers;
  for (const Vec3& p : c.points)
    if (p.allFinite() && centers.size() < 4) centers.push_back(p);
  if (centers.empty()) centers.push_back(Vec3::Zero());
  const auto found = fitting::kmeans({}, c.points, {}, centers, {});
  if (found.of_point.size() != c.points.size()) return "a point has no cluster";
  for (const Vec3& center : found.centers)
    if (!center.allFinite()) return "a center is not finite";
  for (std::size_t i = 0; i < c.points.size(); ++i) {
    if (!c.points[i].allFinite()) {
      if (found.of_point[i] != geometry::kNoIndex) return "a point that is not finite has a cluster";
      continue;
    }
    if (found.of_point[i] >= found.centers.size()) return "a cluster that is none";
    const double mine = (c.points[i] - found.centers[found.of_point[i]]).norm();
    for (const Vec3& center : found.centers)
      if ((c.points[i] - center).norm() < mine - 1e-5 * c.size_m - resolution_m(c))
        return "point " + std::to_string(i) + " is nearer to another center";
  }
  return {};
}

}  // namespace

std::vector<Row> point_rows() {
  std::vector<Row> rows;
  for (const PointSetCase& c : bodice_test::extreme_point_sets()) {
    rows.push_back({"mvee", c.name, [&c] { return check_mvee(c, fitting::mvee(c.points), 1e-6); }});
    rows.push_back({"mvee_first_order", c.name,
                    [&c] { return check_mvee(c, fitting::mvee_first_order(c.points, 1e-2), 2e-2); }});
    rows.push_back({"kmeans", c.name, [&c] { return check_kmeans(c); }});
  }
  return rows;
}

}  // namespace extremes
