#include <bodice_test/shapes.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

#include <bodice/engine/random.hpp>

namespace bodice_test {
namespace {

using bodice::geometry::Index;
using bodice::geometry::Triangle;

constexpr double kTwoPi = 2.0 * std::numbers::pi;

TriMesh icosahedron() {
  const double g = std::numbers::phi;
  TriMesh m;
  m.positions = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                 {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  m.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                 {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                 {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  return m;
}

TriMesh split_in_four(const TriMesh& mesh) {
  TriMesh fine{mesh.positions, {}};
  std::map<std::pair<Index, Index>, Index> middles;
  auto middle = [&](Index a, Index b) {
    const auto [at, fresh] =
        middles.try_emplace(std::minmax(a, b), static_cast<Index>(fine.positions.size()));
    if (fresh) fine.positions.push_back(0.5 * (mesh.positions[a] + mesh.positions[b]));
    return at->second;
  };
  for (const Triangle& t : mesh.triangles) {
    const Triangle m = {middle(t[0], t[1]), middle(t[1], t[2]), middle(t[2], t[0])};
    fine.triangles.insert(fine.triangles.end(),
                          {{t[0], m[0], m[2]}, {t[1], m[1], m[0]}, {t[2], m[2], m[1]}, m});
  }
  return fine;
}

/// Adds a grid of (rows + 1) x columns vertices, closed around the columns, as quads cut in two.
void add_tube(TriMesh& mesh, int rows, int columns, bool close_rows) {
  auto at = [&](int row, int column) {
    return static_cast<Index>((close_rows ? row % rows : row) * columns + column % columns);
  };
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      mesh.triangles.push_back({at(r, c), at(r + 1, c), at(r + 1, c + 1)});
      mesh.triangles.push_back({at(r, c), at(r + 1, c + 1), at(r, c + 1)});
    }
}

}  // namespace

TriMesh icosphere(double radius_m, int subdivisions, const Vec3& center) {
  TriMesh mesh = icosahedron();
  for (int i = 0; i < subdivisions; ++i) {
    mesh = split_in_four(mesh);
    for (Vec3& p : mesh.positions) p.normalize();
  }
  for (Vec3& p : mesh.positions) p = center + radius_m * p.normalized();
  return mesh;
}

TriMesh box(const Vec3& half_size_m, int cells, const Vec3& center) {
  TriMesh mesh;
  std::map<std::array<int, 3>, Index> known;  // lattice points shared by faces
  auto vertex = [&](const std::array<int, 3>& lattice) {
    const auto [at, fresh] = known.try_emplace(lattice, static_cast<Index>(mesh.positions.size()));
    if (fresh) {
      const Vec3 unit = 2.0 / cells * Vec3(lattice[0], lattice[1], lattice[2]) - Vec3::Ones();
      mesh.positions.push_back(center + half_size_m.cwiseProduct(unit));
    }
    return at->second;
  };
  for (int axis = 0; axis < 3; ++axis)
    for (int side : {0, cells})
      for (int i = 0; i < cells; ++i)
        for (int j = 0; j < cells; ++j) {
          auto corner = [&](int u, int v) {
            std::array<int, 3> lattice{};
            lattice[axis] = side;
            lattice[(axis + 1) % 3] = i + u;
            lattice[(axis + 2) % 3] = j + v;
            return vertex(lattice);
          };
          std::array<Index, 4> q = {corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
          if (side == 0) std::swap(q[1], q[3]);
          mesh.triangles.push_back({q[0], q[1], q[2]});
          mesh.triangles.push_back({q[0], q[2], q[3]});
        }
  return mesh;
}

TriMesh cylinder(double radius_m, double height_m, int around, int along, bool caps) {
  TriMesh mesh;
  for (int r = 0; r <= along; ++r)
    for (int c = 0; c < around; ++c) {
      const double angle = kTwoPi * c / around;
      mesh.positions.emplace_back(radius_m * std::cos(angle),
                                  height_m * (static_cast<double>(r) / along - 0.5),
                                  radius_m * std::sin(angle));
    }
  add_tube(mesh, along, around, false);
  if (!caps) return mesh;
  const auto bottom = static_cast<Index>(mesh.positions.size());
  mesh.positions.emplace_back(0.0, -0.5 * height_m, 0.0);
  mesh.positions.emplace_back(0.0, 0.5 * height_m, 0.0);
  const auto last_row = static_cast<Index>(along * around);
  for (Index c = 0, n = static_cast<Index>(around); c < n; ++c) {
    mesh.triangles.push_back({bottom, c, (c + 1) % n});
    mesh.triangles.push_back({bottom + 1, last_row + (c + 1) % n, last_row + c});
  }
  return mesh;
}

TriMesh torus(double major_m, double minor_m, int around, int across) {
  TriMesh mesh;
  for (int r = 0; r < around; ++r)
    for (int c = 0; c < across; ++c) {
      const double u = kTwoPi * r / around;
      const double v = kTwoPi * c / across;
      const double reach = major_m + minor_m * std::cos(v);
      mesh.positions.emplace_back(reach * std::cos(u), minor_m * std::sin(v), -reach * std::sin(u));
    }
  add_tube(mesh, around, across, true);
  return mesh;
}

TriMesh sheet(double width_m, double depth_m, int cells_x, int cells_z) {
  TriMesh mesh;
  for (int z = 0; z <= cells_z; ++z)
    for (int x = 0; x <= cells_x; ++x)
      mesh.positions.emplace_back(width_m * (static_cast<double>(x) / cells_x - 0.5), 0.0,
                                  depth_m * (static_cast<double>(z) / cells_z - 0.5));
  auto at = [&](int x, int z) { return static_cast<Index>(z * (cells_x + 1) + x); };
  for (int z = 0; z < cells_z; ++z)
    for (int x = 0; x < cells_x; ++x) {
      mesh.triangles.push_back({at(x, z), at(x, z + 1), at(x + 1, z + 1)});
      mesh.triangles.push_back({at(x, z), at(x + 1, z + 1), at(x + 1, z)});
    }
  return mesh;
}

TriMesh joined(const TriMesh& a, const TriMesh& b) {
  TriMesh mesh = a;
  const auto shift = static_cast<Index>(a.positions.size());
  mesh.positions.insert(mesh.positions.end(), b.positions.begin(), b.positions.end());
  for (const Triangle& t : b.triangles) mesh.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
  return mesh;
}

TriMesh soup(const TriMesh& mesh) {
  TriMesh result;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto first = static_cast<Index>(3 * t);
    for (int k = 0; k < 3; ++k) result.positions.push_back(mesh.corner(t, k));
    result.triangles.push_back({first, first + 1, first + 2});
  }
  return result;
}

TriMesh moved(TriMesh mesh, double scale, const Vec3& offset) {
  for (Vec3& p : mesh.positions) p = scale * p + offset;
  return mesh;
}

TriMesh shuffled(const TriMesh& mesh, std::uint64_t seed) {
  bodice::engine::Random random(seed);
  auto permutation = [&](std::size_t count) {
    std::vector<Index> order(count);
    std::iota(order.begin(), order.end(), 0u);
    for (std::size_t i = count; i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
    return order;
  };
  const std::vector<Index> to = permutation(mesh.positions.size());
  TriMesh result;
  result.positions.resize(mesh.positions.size());
  for (std::size_t v = 0; v < to.size(); ++v) result.positions[to[v]] = mesh.positions[v];
  for (Index t : permutation(mesh.triangles.size())) {
    Triangle corners = mesh.triangles[t];
    std::rotate(corners.begin(), corners.begin() + random.below(3), corners.end());
    for (Index& v : corners) v = to[v];
    result.triangles.push_back(corners);
  }
  return result;
}

}  // namespace bodice_test
