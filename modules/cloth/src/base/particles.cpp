#include "base/particles.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <bodice/geometry/detail/morton.hpp>

#include "base/schedule.hpp"

namespace bodice::inline v0_1::cloth {
namespace {

// The least mass, a fraction of the mean: a sliver triangle would give a particle so light that others fling
// it about.
constexpr double kMassFloor = 1e-4;

std::vector<double> vertex_masses(const geometry::TriMesh& mesh, double density) {
  std::vector<double> mass(mesh.positions.size(), 0.0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const double third = density * geometry::area_vector(mesh, t).norm() / 6.0;
    for (const Index v : mesh.triangles[t]) mass[v] += third;
  }
  const double mean = std::accumulate(mass.begin(), mass.end(), 0.0) / static_cast<double>(mass.size());
  for (double& m : mass) m = std::max(m, kMassFloor * mean);
  return mass;
}

}  // namespace

std::vector<Index> morton_order(const std::vector<Vec3>& positions) {
  const geometry::Box box = geometry::bounding_box(positions);
  const double side = box.size().maxCoeff();
  std::vector<std::pair<std::uint32_t, Index>> keyed(positions.size());
  for (Index i = 0; i < positions.size(); ++i) {
    const auto cell = [&](int axis) {
      const double t = side > 0.0 ? (positions[i][axis] - box.low[axis]) / side : 0.0;
      return static_cast<std::uint32_t>(std::clamp(t, 0.0, 1.0) * 1023.0);
    };
    keyed[i] = {geometry::morton_code(cell(0), cell(1), cell(2)), i};
  }
  std::sort(keyed.begin(), keyed.end());
  std::vector<Index> order;
  for (const auto& [code, i] : keyed) order.push_back(i);
  return order;
}

Particles make_particles(const geometry::TriMesh& mesh, double density_kg_m2,
                         const std::vector<bool>& pinned) {
  Particles p;
  const std::size_t count = mesh.positions.size();
  p.size = count;
  for (auto* array :
       {&p.x, &p.y, &p.z, &p.old_x, &p.old_y, &p.old_z, &p.vx, &p.vy, &p.vz, &p.mass, &p.inverse_mass}) {
    array->assign((count + 3) / 4 * 4, 0.0f);
  }
  p.point.assign(count + idle_particles(count) + 3, Point{});
  p.origin = geometry::bounding_box(mesh.positions).center();
  const std::vector<double> mass = vertex_masses(mesh, density_kg_m2);
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 local = mesh.positions[i] - p.origin;
    p.x[i] = p.old_x[i] = static_cast<float>(local[0]);
    p.y[i] = p.old_y[i] = static_cast<float>(local[1]);
    p.z[i] = p.old_z[i] = static_cast<float>(local[2]);
    p.mass[i] = static_cast<float>(mass[i]);
    p.inverse_mass[i] = pinned[i] ? 0.0f : static_cast<float>(1.0 / mass[i]);
    p.point[i] = {p.x[i], p.y[i], p.z[i], p.inverse_mass[i]};  // for the report of a first frame without time
  }
  return p;
}

void rebase(Particles& particles, const Vec3& origin) {
  const Vec3 shift = particles.origin - origin;
  if (shift == Vec3::Zero()) return;
  auto move = [](std::vector<float>& values, double by) {
    for (float& v : values) v = static_cast<float>(static_cast<double>(v) + by);
  };
  move(particles.x, shift[0]), move(particles.old_x, shift[0]);
  move(particles.y, shift[1]), move(particles.old_y, shift[1]);
  move(particles.z, shift[2]), move(particles.old_z, shift[2]);
  particles.origin = origin;
}

}  // namespace bodice::cloth
