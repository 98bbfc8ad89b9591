// Proxies and particles that the suite shares; all are made from a seed.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include <bodice/collision/collider.hpp>
#include <bodice/engine/random.hpp>

namespace bodice_test {

using bodice::geometry::Ellipsoid;
using bodice::geometry::Mat3;
using bodice::geometry::Vec3;

inline constexpr float kInf = std::numeric_limits<float>::infinity();

inline Vec3 random_vector(bodice::engine::Random& random, double half_side) {
  const double x = random.uniform(-half_side, half_side);
  const double y = random.uniform(-half_side, half_side);
  return {x, y, random.uniform(-half_side, half_side)};
}

inline Vec3 random_direction(bodice::engine::Random& random) {
  const double x = random.normal(), y = random.normal();
  return Vec3(x, y, random.normal()).normalized();
}

inline Mat3 random_rotation(bodice::engine::Random& random) {
  const Vec3 axis = random_direction(random);
  return Eigen::AngleAxisd(random.uniform(0.0, 3.14159), axis).toRotationMatrix();
}

/// Ellipsoids with centers in a cube of the given half side and radii log-uniform between the two limits.
inline std::vector<Ellipsoid> random_ellipsoids(std::uint64_t seed, int count, double half_side, double least,
                                                double largest) {
  bodice::engine::Random random(seed);
  std::vector<Ellipsoid> result(static_cast<std::size_t>(count));
  for (Ellipsoid& e : result) {
    e.center = random_vector(random, half_side);
    e.axes = random_rotation(random);
    for (int axis = 0; axis < 3; ++axis) e.radii[axis] = least * std::pow(largest / least, random.uniform());
  }
  return result;
}

/// A limb: a chain of overlapping ellipsoids along x, 5 cm thick.
inline std::vector<Ellipsoid> limb() {
  std::vector<Ellipsoid> shapes(9);
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    shapes[k].center.x() = 0.08 * (static_cast<double>(k) - 4.0);
    shapes[k].radii = Vec3(0.08, 0.05, 0.045);
  }
  return shapes;
}

inline bodice::proxy::BodyProxy::Data data_of(const std::vector<Ellipsoid>& shapes) {
  bodice::proxy::BodyProxy::Data data;
  data.tier = bodice::proxy::Tier::kSolid;
  data.stature_m = 1.7;
  for (std::size_t k = 0; k < shapes.size(); ++k)
    data.ellipsoids.push_back({shapes[k], static_cast<bodice::body::Part>(k % bodice::body::kPartCount)});
  return data;
}

inline bodice::proxy::BodyProxy proxy_of(const bodice::proxy::BodyProxy::Data& data) {
  auto proxy = bodice::proxy::BodyProxy::make(data);
  if (!proxy.ok()) throw std::runtime_error(proxy.error().sentence());
  return std::move(proxy).value();
}

inline bodice::proxy::BodyProxy proxy_of(const std::vector<Ellipsoid>& shapes) {
  return proxy_of(data_of(shapes));
}

/// Adds a relief table to every ellipsoid: heights within +-h_m and slopes of the same range. `make`
/// (ellipsoid, column, row) returns the texels. Border nodes are tied as the octahedral map requires.
template <class Make>
bodice::proxy::BodyProxy::Data with_tables(bodice::proxy::BodyProxy::Data data, int nodes, double h_m,
                                           Make&& make) {
  data.tier = bodice::proxy::Tier::kRelief;
  for (std::size_t k = 0; k < data.ellipsoids.size(); ++k) {
    bodice::proxy::ReliefTable table;
    table.nodes_per_side = static_cast<std::uint16_t>(nodes);
    table.h_scale_m = static_cast<float>(2.0 * h_m);
    table.h_offset_m = static_cast<float>(-h_m);
    table.a_scale = static_cast<float>(2.0 * h_m);
    table.a_offset = static_cast<float>(-h_m);
    table.first_texel = static_cast<std::uint32_t>(data.texels.size());
    data.relief.push_back(table);
    const std::size_t first = data.texels.size();
    const auto texel = [&](int i, int j) -> bodice::proxy::ReliefTexel& {
      return data.texels[first + static_cast<std::size_t>(j * nodes + i)];
    };
    for (int j = 0; j < nodes; ++j)
      for (int i = 0; i < nodes; ++i) data.texels.push_back(make(k, i, j));
    for (int i = 0; i < nodes; ++i) {
      texel(nodes - 1 - i, 0) = texel(i, 0);
      texel(nodes - 1 - i, nodes - 1) = texel(i, nodes - 1);
      texel(0, nodes - 1 - i) = texel(0, i);
      texel(nodes - 1, nodes - 1 - i) = texel(nodes - 1, i);
    }
    texel(nodes - 1, 0) = texel(0, nodes - 1) = texel(nodes - 1, nodes - 1) = texel(0, 0);
  }
  return data;
}

/// Adds tables with random texels.
inline bodice::proxy::BodyProxy::Data with_relief(bodice::proxy::BodyProxy::Data data, int nodes, double h_m,
                                                  std::uint64_t seed) {
  bodice::engine::Random random(seed);
  return with_tables(std::move(data), nodes, h_m, [&](std::size_t, int, int) {
    const auto h = static_cast<std::uint8_t>(random.below(256));
    return bodice::proxy::ReliefTexel{h, static_cast<std::uint8_t>(random.below(256))};
  });
}

/// Adds tables in which one octant of each ellipsoid is high and the others are low.
inline bodice::proxy::BodyProxy::Data with_lopsided_relief(bodice::proxy::BodyProxy::Data data, int nodes,
                                                           double h_m) {
  return with_tables(std::move(data), nodes, h_m, [&](std::size_t k, int i, int j) {
    const int x = 2 * i - (nodes - 1), y = 2 * j - (nodes - 1);
    const int octant = (x < 0) | (y < 0) << 1 | (std::abs(x) + std::abs(y) > nodes - 1) << 2;
    const bool high = octant == static_cast<int>(k % 8);
    return bodice::proxy::ReliefTexel{static_cast<std::uint8_t>(high ? 255 : 0), 128};
  });
}

/// Particles with their storage.
struct Cloud {
  std::vector<float> x, y, z, vx, vy, vz, sx, sy, sz;

  void add(const Vec3& p, const Vec3& v = Vec3::Zero()) {
    x.push_back(static_cast<float>(p.x()));
    y.push_back(static_cast<float>(p.y()));
    z.push_back(static_cast<float>(p.z()));
    vx.push_back(static_cast<float>(v.x()));
    vy.push_back(static_cast<float>(v.y()));
    vz.push_back(static_cast<float>(v.z()));
  }
  void add_safe(const Vec3& s) {
    sx.push_back(static_cast<float>(s.x()));
    sy.push_back(static_cast<float>(s.y()));
    sz.push_back(static_cast<float>(s.z()));
  }
  std::size_t size() const { return x.size(); }
  Vec3 position(std::size_t i) const { return {double{x[i]}, double{y[i]}, double{z[i]}}; }
  Vec3 velocity(std::size_t i) const { return {double{vx[i]}, double{vy[i]}, double{vz[i]}}; }
  bodice::collision::Particles particles() {
    bodice::collision::Particles p{size(), x.data(), y.data(), z.data(), vx.data(), vy.data(), vz.data()};
    if (!sx.empty()) p.safe_x = sx.data(), p.safe_y = sy.data(), p.safe_z = sz.data();
    return p;
  }
};

/// The oracle of the suite: the union distance by brute force in double precision.
inline bodice::geometry::ClosestPoint brute_force(const std::vector<Ellipsoid>& shapes, const Vec3& p,
                                                  std::uint32_t* owner = nullptr) {
  bodice::geometry::ClosestPoint best;
  best.signed_distance = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    const auto at = bodice::geometry::closest_point(shapes[k], p);
    if (at.signed_distance >= best.signed_distance) continue;
    best = at;
    if (owner) *owner = static_cast<std::uint32_t>(k);
  }
  return best;
}

/// One ball around the origin.
inline std::vector<Ellipsoid> ball(double radius_m) {
  std::vector<Ellipsoid> shapes(1);
  shapes[0].radii.setConstant(radius_m);
  return shapes;
}

/// Points spread evenly over a cube around the origin.
inline std::vector<Vec3> points_around(std::uint64_t seed, int count, double half_side) {
  bodice::engine::Random random(seed);
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) points.push_back(random_vector(random, half_side));
  return points;
}

}  // namespace bodice_test
