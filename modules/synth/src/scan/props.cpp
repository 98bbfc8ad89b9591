#include "scan/props.hpp"

#include <algorithm>
#include <cmath>

namespace bodice::inline v0_1::synth {
namespace {

using geometry::Box;
using geometry::Index;
using geometry::TriMesh;
using geometry::Vec3;

/// Appends a grid of quads from `corner` along `u` and `v`, wound around u x v.
void add_grid(const Vec3& corner, const Vec3& u, const Vec3& v, double edge_m, TriMesh& mesh) {
  const int n = std::max(1, static_cast<int>(u.norm() / edge_m)),
            m = std::max(1, static_cast<int>(v.norm() / edge_m));
  const auto first = static_cast<Index>(mesh.positions.size());
  for (int j = 0; j <= m; ++j)
    for (int i = 0; i <= n; ++i) mesh.positions.push_back(corner + u * i / n + v * j / m);
  const auto at = [&](int i, int j) { return first + static_cast<Index>(j * (n + 1) + i); };
  for (int j = 0; j < m; ++j)
    for (int i = 0; i < n; ++i) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
}

}  // namespace

TriMesh box_mesh(const Box& box, double edge_m) {
  const Vec3 s = box.size(), x = s.x() * Vec3::UnitX(), y = s.y() * Vec3::UnitY(), z = s.z() * Vec3::UnitZ();
  TriMesh mesh;
  add_grid(box.low, y, x, edge_m, mesh);
  add_grid(box.low, x, z, edge_m, mesh);
  add_grid(box.low, z, y, edge_m, mesh);
  add_grid(box.low + z, x, y, edge_m, mesh);
  add_grid(box.low + y, z, x, edge_m, mesh);
  add_grid(box.low + x, y, z, edge_m, mesh);
  return mesh;
}

double distance_to_box(const Box& box, const Vec3& point) {
  const Vec3 q = (point - box.center()).cwiseAbs() - 0.5 * box.size();
  return q.cwiseMax(0.0).norm() + std::min(q.maxCoeff(), 0.0);
}

std::vector<Box> chair(const Vec3& seat) {
  constexpr double kHalf_m = 0.22, kBoard_m = 0.04, kLeg_m = 0.04, kBack_m = 0.5, kHeight_m = 0.45;
  const auto box = [&](const Vec3& low, const Vec3& high) { return Box{seat + low, seat + high}; };
  std::vector<Box> parts = {box({-kHalf_m, -kBoard_m, -kHalf_m}, {kHalf_m, 0.0, kHalf_m}),
                            box({-kHalf_m, 0.0, -kHalf_m - kBoard_m}, {kHalf_m, kBack_m, -kHalf_m})};
  for (const double x : {-kHalf_m, kHalf_m - kLeg_m})
    for (const double z : {-kHalf_m, kHalf_m - kLeg_m})
      parts.push_back(box({x, -kHeight_m, z}, {x + kLeg_m, -kBoard_m, z + kLeg_m}));
  return parts;
}

TriMesh floor_sheet(double side_m, double edge_m, double noise_m, engine::Random& random) {
  TriMesh mesh;
  add_grid({-0.5 * side_m, 0.0, -0.5 * side_m}, side_m * Vec3::UnitZ(), side_m * Vec3::UnitX(), edge_m, mesh);
  for (Vec3& p : mesh.positions) p.y() += noise_m * random.normal();
  return mesh;
}

TriMesh debris(const Vec3& around, double size_m, engine::Random& random) {
  TriMesh mesh;
  const auto corner = [&] {
    return Vec3(around + size_m * Vec3(random.normal(), random.normal(), random.normal()));
  };
  const int count = 3 + static_cast<int>(random.below(12));
  mesh.positions = {corner(), corner()};
  for (int i = 0; i < count; ++i) {
    mesh.positions.push_back(corner());
    const auto last = static_cast<Index>(mesh.positions.size() - 1);
    mesh.triangles.push_back({last - 2, last - 1, last});
  }
  return mesh;
}

}  // namespace bodice::synth
