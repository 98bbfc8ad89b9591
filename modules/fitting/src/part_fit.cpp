#include "part_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bodice::fitting {
namespace {

using geometry::Vec3;

double radial_distance(const geometry::Ellipsoid& e, const Vec3& p) {
  return (p - geometry::radial_projection(e, p)).norm();
}

}  // namespace

std::vector<PartFit> part_fits(const LabelledSkin& skin, std::span<const proxy::ProxyEllipsoid> ellipsoids,
                               const Measured& measured, std::uint32_t parts) {
  std::vector<double> sum(ellipsoids.size(), 0.0), count(ellipsoids.size(), 0.0);
  std::array<PartFit, body::kPartCount> all{};
  std::array<std::vector<std::size_t>, body::kPartCount> of_part;
  for (std::size_t k = 0; k < ellipsoids.size(); ++k)
    of_part[static_cast<int>(ellipsoids[k].part)].push_back(k);
  for (std::size_t v = 0; v < skin.part.size(); ++v) {
    const int part = static_cast<int>(skin.part[v]);
    ++all[part].vertices;
    double least = std::numeric_limits<double>::infinity();
    std::size_t owner = ellipsoids.size();
    for (const std::size_t k : of_part[part]) {
      const double d = radial_distance(ellipsoids[k].shape, skin.mesh.positions[v]);
      if (d < least) least = d, owner = k;
    }
    if (owner == ellipsoids.size()) continue;
    sum[owner] += least;
    count[owner] += 1.0;
  }
  std::vector<PartFit> result;
  for (int part = 0; part < body::kPartCount; ++part) {
    PartFit& fit = all[part];
    if (fit.vertices == 0 || !((parts >> part) & 1u)) continue;
    fit.part = static_cast<body::Part>(part);
    fit.ellipsoids = of_part[part].size();
    double vertices = 0.0;
    for (const std::size_t k : of_part[part]) {
      if (count[k] == 0.0) continue;
      fit.radial_error_mean_m += sum[k];
      vertices += count[k];
      fit.radial_error_max_m = std::max(fit.radial_error_max_m, sum[k] / count[k]);
    }
    if (vertices > 0.0) fit.radial_error_mean_m /= vertices;
    fit.gap_m = measured.gap_of_part[part];
    result.push_back(fit);
  }
  return result;
}

}  // namespace bodice::fitting
