#include "score.hpp"

#include <cmath>

namespace bench {
namespace {

using bodice::geometry::Vec3;

/// Labels follow skin weights, so a band at each border is a convention, not a fact.
constexpr double kBand = 0.03 / 1.7;  // of the stature: 3 cm

std::vector<Vec3> border_points(const Case& c) {
  std::vector<Vec3> points;
  for (const auto& t : c.mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      const auto a = t[k], b = t[(k + 1) % 3];
      if (a < b && c.truth[a] != c.truth[b])
        points.push_back(0.5 * (c.mesh.positions[a] + c.mesh.positions[b]));
    }
  return points;
}

std::vector<double> vertex_areas(const bodice::geometry::TriMesh& mesh) {
  std::vector<double> area(mesh.positions.size(), 0.0);
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
    for (const auto v : mesh.triangles[f]) area[v] += bodice::geometry::area_vector(mesh, f).norm() / 6.0;
  return area;
}

bool near_any(const std::vector<Vec3>& points, const Vec3& p, double radius) {
  for (const Vec3& q : points)
    if ((p - q).squaredNorm() < radius * radius) return true;
  return false;
}

bool other_side(int a, int b) {
  return a >= 3 && b >= 3 && std::abs(a - b) == 4;
}

void score_labels(const Case& c, const bodice::anatomy::Anatomy& anatomy, Score& s) {
  const std::vector<Vec3> border = border_points(c);
  const std::vector<double> area = vertex_areas(c.mesh);
  const double band = kBand * (c.stature > 0.0 ? c.stature : anatomy.stature_m);
  double all = 0.0, right = 0.0, limbs = 0.0, swapped = 0.0;
  for (std::size_t v = 0; v < c.truth.size(); ++v) {
    if (c.truth[v] < 0 || near_any(border, c.mesh.positions[v], band)) continue;
    const int found = coarse_class(anatomy.part[v]);
    all += area[v];
    right += found == c.truth[v] ? area[v] : 0.0;
    limbs += c.truth[v] >= 3 ? area[v] : 0.0;
    swapped += other_side(found, c.truth[v]) ? area[v] : 0.0;
  }
  s.agreement = all > 0.0 ? right / all : 0.0;
  s.swapped = limbs > 0.0 ? swapped / limbs : 0.0;
}

}  // namespace

Score score(const Case& c, const bodice::anatomy::Anatomy& anatomy) {
  Score s;
  if (!c.truth.empty()) score_labels(c, anatomy, s);
  for (const auto& mark : anatomy.landmarks) {
    const auto truth = c.landmarks.find(std::string(bodice::body::name(mark.id)));
    if (truth == c.landmarks.end()) continue;
    const double error = (mark.position - truth->second).norm() / c.stature;
    s.error[truth->first] = error;
    if (error > s.worst_landmark) {
      s.worst_landmark = error;
      s.worst_name = truth->first;
    }
  }
  if (c.stature > 0.0) s.stature_ratio = anatomy.stature_m / c.stature;
  return s;
}

}  // namespace bench
