#include <limits>

#include <Eigen/Geometry>

#include <bodice/engine/random.hpp>
#include <bodice_test/extremes.hpp>

#include "not_finite.hpp"

namespace bodice_test {
namespace {

using bodice::engine::Random;
using bodice::geometry::Box;

constexpr double kTenKilometers = 1e4;

using Points = std::vector<Vec3>;

Points lattice(int nx, int ny, int nz) {
  Points points;
  for (int x = 0; x < nx; ++x)
    for (int y = 0; y < ny; ++y)
      for (int z = 0; z < nz; ++z) points.emplace_back(x, y, z);
  return points;
}

Points cloud(int count, const Vec3& half_size, std::uint64_t seed) {
  Random random(seed);
  Points points;
  for (int i = 0; i < count; ++i) {
    Vec3 p;
    for (int k = 0; k < 3; ++k) p[k] = half_size[k] * random.uniform(-1.0, 1.0);
    points.push_back(p);
  }
  return points;
}

Points on_sphere(int count, std::uint64_t seed) {
  Random random(seed);
  Points points;
  for (int i = 0; i < count; ++i) {
    const Vec3 direction(random.normal(), random.normal(), random.normal());
    points.push_back(direction.stableNormalized());
  }
  return points;
}

/// The points after an arbitrary rotation, so that nothing is aligned with the axes by chance.
Points turned(Points points) {
  const Eigen::Matrix3d rotation = Eigen::Quaterniond(0.7, -0.3, 0.5, 0.4).normalized().toRotationMatrix();
  for (Vec3& p : points) p = rotation * p;
  return points;
}

Points placed(Points points, double scale, const Vec3& offset) {
  for (Vec3& p : points) p = scale * p + offset;
  return points;
}

Points with(Points points, const Points& more) {
  points.insert(points.end(), more.begin(), more.end());
  return points;
}

class Table {
 public:
  void add(std::string name, Points points, int dimension) {
    PointSetCase row{std::move(name), std::move(points)};
    Box box;
    for (const Vec3& p : row.points) {
      if (p.allFinite())
        box.extend(p);
      else
        row.finite = false;
    }
    row.dimension = dimension;
    row.size_m = box.size().norm();
    row.offset_m = box.empty() ? 0.0 : box.center().norm();
    rows_.push_back(std::move(row));
  }
  std::vector<PointSetCase> take() { return std::move(rows_); }

 private:
  std::vector<PointSetCase> rows_;
};

void add_few(Table& table) {
  const Vec3 p(0.3, -0.2, 0.9);
  const Vec3 q(1.1, 0.4, -0.5);
  table.add("no points", {}, -1);
  table.add("one point", {p}, 0);
  table.add("one point at the origin", {Vec3::Zero()}, 0);
  table.add("two points", {p, q}, 1);
  table.add("three points", {p, q, Vec3(0.0, 1.0, 0.0)}, 2);
  table.add("four points, a tetrahedron", {p, q, Vec3(0.0, 1.0, 0.0), Vec3(-1.0, -1.0, 0.2)}, 3);
  table.add("four points in a plane", {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)}, 2);
  table.add("four points in a rotated plane",
            turned({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)}), 2);
  table.add("one point, 64 times", Points(64, p), 0);
  table.add("two points, 32 times each", with(Points(32, p), Points(32, q)), 1);
}

void add_flat(Table& table) {
  Points line;
  for (int i = 0; i < 50; ++i) line.push_back(Vec3(1.0, 2.0, -0.5) * (0.02 * i) + Vec3(3.0, 0.0, 1.0));
  table.add("collinear, oblique", line, 1);
  table.add("collinear, on an axis", lattice(20, 1, 1), 1);
  table.add("coplanar lattice", lattice(6, 6, 1), 2);
  table.add("coplanar cloud, rotated", turned(cloud(200, {1.0, 0.7, 0.0}, 1)), 2);
  table.add("coplanar but for 1e-9", turned(cloud(200, {1.0, 0.7, 1e-9}, 2)), 3);
  table.add("coplanar but for 1e-14", turned(cloud(200, {1.0, 0.7, 1e-14}, 3)), 3);
}

void add_solid(Table& table) {
  table.add("cube corners", lattice(2, 2, 2), 3);
  table.add("lattice 4x4x4, all ties", lattice(4, 4, 4), 3);
  table.add("lattice with every point twice", with(lattice(3, 3, 3), lattice(3, 3, 3)), 3);
  table.add("needle 1e3", turned(cloud(300, {1.0, 1e-3, 1e-3}, 4)), 3);
  table.add("needle 1e6", turned(cloud(300, {1.0, 1e-6, 1e-6}, 5)), 3);
  table.add("blade 1 : 1e-3 : 1e-6", turned(cloud(300, {1.0, 1e-3, 1e-6}, 6)), 3);
  table.add("points on a sphere", on_sphere(300, 7), 3);
  table.add("cluster with one outlier 1000 times away",
            with(cloud(200, Vec3::Constant(1e-3), 8), {Vec3(1.0, 0.5, 0.2)}), 3);
  table.add(
      "two clusters far apart",
      with(cloud(100, Vec3::Constant(1e-3), 9), placed(cloud(100, Vec3::Constant(1e-3), 10), 1.0, {5, 1, 2})),
      3);
}

void add_scaled(Table& table) {
  const Points cloud3 = turned(cloud(150, {1.0, 0.4, 0.2}, 11));
  const Vec3 far = kTenKilometers * Vec3(0.6, -0.64, 0.48);
  for (const auto& [scale, label] : {std::pair{1e-6, "1e-6"}, {1e-3, "1e-3"}, {1e3, "1e3"}, {1e6, "1e6"}})
    table.add(std::string("cloud at scale ") + label, placed(cloud3, scale, Vec3::Zero()), 3);
  table.add("cloud 10 km away", placed(cloud3, 1.0, far), 3);
  table.add("millimeter cloud 10 km away", placed(cloud3, 1e-3, far), 3);
  table.add("sphere of radius 1e-6", placed(on_sphere(200, 12), 1e-6, Vec3::Zero()), 3);
  table.add("sphere of radius 1e6", placed(on_sphere(200, 13), 1e6, Vec3::Zero()), 3);
}

void add_not_finite(Table& table) {
  const Points good = turned(cloud(100, {1.0, 0.4, 0.2}, 14));
  table.add("cloud with a NaN point", with(good, {Vec3::Constant(kNan)}), 3);
  table.add("cloud with a NaN coordinate first", with({Vec3(0.1, kNan, 0.2)}, good), 3);
  table.add("cloud with an infinite point", with(good, {Vec3(kInf, 0.0, 0.0)}), 3);
  table.add("cloud with both infinities", with(good, {Vec3(kInf, 0.0, 0.0), Vec3(-kInf, 0.0, 0.0)}), 3);
  table.add("NaN alone", {Vec3::Constant(kNan)}, -1);
  table.add("only NaN and Inf", {Vec3::Constant(kNan), Vec3::Constant(kInf), Vec3::Constant(-kInf)}, -1);
}

}  // namespace

const std::vector<PointSetCase>& extreme_point_sets() {
  static const std::vector<PointSetCase> rows = [] {
    Table table;
    add_few(table);
    add_flat(table);
    add_solid(table);
    add_scaled(table);
    add_not_finite(table);
    return table.take();
  }();
  return rows;
}

const std::vector<double>& extreme_values() {
  static const std::vector<double> values = {0.0,
                                             -0.0,
                                             std::numeric_limits<double>::denorm_min(),
                                             std::numeric_limits<double>::min(),
                                             1e-300,
                                             1e-150,
                                             1e-30,
                                             1e-6,
                                             1.0,
                                             -1.0,
                                             1e6,
                                             1e30,
                                             1e150,
                                             -1e300,
                                             std::numeric_limits<double>::max(),
                                             std::numeric_limits<double>::lowest(),
                                             kInf,
                                             -kInf,
                                             kNan};
  return values;
}

}  // namespace bodice_test
