#include "silhouette.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

namespace bench {
namespace {

using bodice::geometry::TriMesh;
using bodice::geometry::Vec3;

constexpr double kBand_m = 0.04;
constexpr int kSamples = 8;  // a side, so that a coarse mesh has as dense an outline as a fine one
constexpr double kFar = std::numeric_limits<double>::infinity();

/// Left, right, back and front of a band.
struct Extent {
  std::array<double, 4> most = {-kFar, -kFar, -kFar, -kFar};
  void add(const Vec3& p) {
    const double along[4] = {-p.x(), p.x(), -p.z(), p.z()};
    for (std::size_t k = 0; k < 4; ++k) most[k] = std::max(most[k], along[k]);
  }
};

std::map<int, Extent> outline(const TriMesh& mesh) {
  std::map<int, Extent> bands;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k)
      for (int s = 0; s < kSamples; ++s) {
        const double at = static_cast<double>(s) / kSamples;
        const Vec3 p = (1.0 - at) * mesh.corner(t, k) + at * mesh.corner(t, (k + 1) % 3);
        bands[static_cast<int>(std::floor(p.y() / kBand_m))].add(p);
      }
  return bands;
}

}  // namespace

double outline_difference_m(const TriMesh& a, const TriMesh& b) {
  const std::map<int, Extent> first = outline(a), second = outline(b);
  double most = 0.0;
  for (const auto& [band, extent] : first) {
    const auto other = second.find(band);
    if (other == second.end()) continue;
    for (std::size_t k = 0; k < 4; ++k)
      most = std::max(most, std::abs(extent.most[k] - other->second.most[k]));
  }
  return most;
}

}  // namespace bench
