#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include <bodice_test/extremes.hpp>

namespace bodice_test {
namespace {

struct Radii {
  const char* name;
  Vec3 radii;
};

const Radii kRadii[] = {
    {"sphere", {1.0, 1.0, 1.0}},
    {"nearly a sphere", {1.0, 1.0 + 1e-15, 1.0 - 1e-12}},
    {"limb", {0.06, 0.07, 0.25}},
    {"triaxial", {0.3, 1.0, 2.5}},
    {"prolate 10", {0.1, 0.1, 1.0}},
    {"prolate, nearly", {0.1, 0.1 * (1.0 + 1e-10), 1.0}},
    {"oblate 10", {1.0, 0.1, 1.0}},
    {"aspect 1000, triaxial", {1.0, 0.03, 0.001}},
    {"needle 1e6", {1e-6, 1e-6, 1.0}},
    {"disk 1e6", {1.0, 1.0, 1e-6}},
    {"blade 1 : 1e-3 : 1e-6", {1.0, 1e-3, 1e-6}},
};

Eigen::Matrix3d oblique() {
  return Eigen::Quaterniond(0.4, 0.8, -0.3, 0.35).normalized().toRotationMatrix();
}

}  // namespace

const std::vector<EllipsoidCase>& extreme_ellipsoids() {
  static const std::vector<EllipsoidCase> rows = [] {
    std::vector<EllipsoidCase> table;
    for (const Radii& r : kRadii) {
      table.push_back({r.name, {Vec3::Zero(), Eigen::Matrix3d::Identity(), r.radii}});
      table.push_back({std::string(r.name) + ", rotated", {Vec3(0.3, 1.2, -0.4), oblique(), r.radii}});
      table.push_back({std::string(r.name) + ", 1e-6", {Vec3::Zero(), oblique(), 1e-6 * r.radii}});
      table.push_back({std::string(r.name) + ", 1e6", {Vec3::Zero(), oblique(), 1e6 * r.radii}});
      table.push_back({std::string(r.name) + ", 10 km away", {Vec3(6e3, -6.4e3, 4.8e3), oblique(), r.radii}});
    }
    return table;
  }();
  return rows;
}

std::vector<Vec3> hostile_queries(const Ellipsoid& e) {
  // Points in the ellipsoid's frame, as multiples of the radii. Each gets neighbors one rounding away.
  std::vector<Vec3> local = {Vec3::Zero()};
  for (int k = 0; k < 3; ++k)
    for (double t : {1e-300, 1e-12, 0.3, 0.999999, 1.0, 1.000001, 2.0, 1e4})
      for (double sign : {-1.0, 1.0}) local.push_back(sign * t * e.radii[k] * Vec3::Unit(k));
  for (int k = 0; k < 3; ++k)  // symmetry planes
    for (double t : {0.1, 0.5, 0.9999, 1.5}) {
      Vec3 p = t * e.radii;
      p[k] = 0.0;
      local.push_back(p);
    }
  for (double t : {0.2, 0.57735026918962573, 0.6, 3.0}) local.push_back(t * e.radii);
  // The rim of the medial disk: (r_j^2 - r_min^2) / r_j on the longer axes.
  int thin = 0;
  e.radii.minCoeff(&thin);
  for (double inside : {0.5, 1.0 - 1e-12, 1.0, 1.0 + 1e-12})
    for (double angle : {0.0, 0.4, 1.5707963267948966}) {
      const int u = (thin + 1) % 3;
      const int v = (thin + 2) % 3;
      Vec3 p = Vec3::Zero();
      p[u] = inside * std::cos(angle) * (e.radii[u] - e.radii[thin] * e.radii[thin] / e.radii[u]);
      p[v] = inside * std::sin(angle) * (e.radii[v] - e.radii[thin] * e.radii[thin] / e.radii[v]);
      local.push_back(p);
    }
  std::vector<Vec3> queries;
  for (const Vec3& p : local)
    for (double nudge : {0.0, 1e-16, -1e-9}) {
      const Vec3 nudged = p + nudge * e.radii.maxCoeff() * Vec3(1.0, -0.7, 0.3);
      queries.push_back(e.center + e.axes * nudged);
    }
  queries.push_back(e.center + Vec3(6e3, -6.4e3, 4.8e3));
  return queries;
}

}  // namespace bodice_test
