// Based on: Zina H. Cigolle et al. A Survey of Efficient Representations for Independent Unit Vectors. 2014
// (the octahedral map). The chain rule through the map and through the closest point is derived below.
#include "exact/relief_field.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <bodice/proxy/proxy_distance.hpp>

namespace bodice::inline v0_1::collision {

using geometry::Vec3;

namespace {

double sign_of(double v) {
  return v < 0.0 ? -1.0 : 1.0;
}

/// Converts slopes on the octahedral square (gx, gy) to slopes over w. With s = |w_x| + |w_y| + |w_z| and q =
/// w.xy / s, dq_i / dw_j = (delta_ij - q_i sign_j) / s. In the lower half the coordinates of q are swapped
/// and mirrored.
Vec3 from_square(const Vec3& w, double gx, double gy) {
  const double s = w.cwiseAbs().sum();
  const Vec3 sign(sign_of(w.x()), sign_of(w.y()), sign_of(w.z()));
  if (w.z() < 0.0) {
    std::swap(gx, gy);
    gx *= -sign.x() * sign.y();
    gy *= -sign.x() * sign.y();
  }
  const double radial = (gx * w.x() + gy * w.y()) / s;
  return (Vec3(gx, gy, 0.0) - radial * sign) / s;
}

/// A direction on the grid of a table: its cell, and the position there.
struct Cell {
  int texel;    ///< the cell's first node
  double u, v;  ///< in [0, 1]
  double half;  ///< cells a unit of the square
};

Cell cell_of(const BakedTable& table, const Vec3& w) {
  const auto [px, py] = proxy::octahedral_map(w);
  const double half = 0.5 * (table.nodes - 1);
  const double column = (px + 1.0) * half, row = (py + 1.0) * half;
  const int i = std::clamp(static_cast<int>(column), 0, table.nodes - 2);
  const int j = std::clamp(static_cast<int>(row), 0, table.nodes - 2);
  return {j * table.nodes + i, column - i, row - j, half};
}

/// w of eq. (2) in proxy_distance.hpp.
Vec3 unit_direction(const geometry::Ellipsoid& shape, const geometry::ClosestPoint& at) {
  return (shape.axes.transpose() * (at.point - shape.center)).cwiseQuotient(shape.radii).normalized();
}

}  // namespace

TableValue read_table(const ReliefTables& relief, const BakedTable& table, const Vec3& w) {
  const auto [texel, u, v, half] = cell_of(table, w);
  const std::uint8_t* upper = relief.texels.data() + table.first_byte + 2 * texel;
  const std::uint8_t* lower = upper + 2 * table.nodes;
  // Clang 14 does not capture the names of a decomposition by themselves.
  const auto read = [upper, lower, u = u, v = v, half = half](int byte, double& value, double& gx,
                                                              double& gy) {
    const double p00 = upper[byte], p10 = upper[byte + 2], p01 = lower[byte], p11 = lower[byte + 2];
    value = (1 - v) * ((1 - u) * p00 + u * p10) + v * ((1 - u) * p01 + u * p11);
    gx = half * ((1 - v) * (p10 - p00) + v * (p11 - p01));
    gy = half * ((1 - u) * (p01 - p00) + u * (p11 - p10));
  };
  TableValue result;
  double h, hx, hy, a, ax, ay;
  read(0, h, hx, hy);
  read(1, a, ax, ay);
  const double h_scale = double{table.h_scale_m}, a_scale = double{table.a_scale};
  result.h_m = double{table.h_offset_m} + h_scale * h;
  result.a_per_m = double{table.a_offset} + a_scale * a;
  result.h_slope = from_square(w, h_scale * hx, h_scale * hy);
  result.a_slope = from_square(w, a_scale * ax, a_scale * ay);
  return result;
}

TexelStencil texels_around(const UnionField& field, const ReliefTables& relief, std::uint32_t k,
                           const geometry::ClosestPoint& at) {
  const auto [texel, u, v, half] = cell_of(relief.tables[k], unit_direction(field.shape(k), at));
  const auto first = static_cast<std::size_t>(texel), n = static_cast<std::size_t>(relief.tables[k].nodes);
  return {{first, first + 1, first + n, first + n + 1}, {(1 - v) * (1 - u), (1 - v) * u, v * (1 - u), v * u}};
}

ReliefSample correct(const UnionField& field, const ReliefTables& relief, std::uint32_t k,
                     const geometry::ClosestPoint& at) {
  const BakedTable& table = relief.tables[k];
  ReliefSample sample{at.signed_distance, at.normal, k};
  if (table.nodes < 2) return sample;
  const geometry::Ellipsoid& shape = field.shape(k);
  const Vec3 w = unit_direction(shape, at);
  const TableValue value = read_table(relief, table, w);
  const double clamped = std::clamp(at.signed_distance, -double{relief.in_m}, double{relief.out_m});
  sample.distance_m -= value.h_m + value.a_per_m * clamped;
  // The closest point f = r w and the particle y = f + d n, n = (w / r) / |w / r|, give e = r^2 + t with t =
  // d / |w / r|, and dw = (r / e) dy - (w / e) dt, where dt keeps |w| = 1.
  const double t = at.signed_distance / w.cwiseQuotient(shape.radii).norm();
  const double least = 1e-9 * shape.radii.minCoeff() * shape.radii.minCoeff();
  const Vec3 e = (shape.radii.cwiseAbs2().array() + t).max(least).matrix();
  const Vec3 slope = value.h_slope + clamped * value.a_slope;
  const Vec3 we = w.cwiseQuotient(e);
  const Vec3 rest = slope - w * (slope.dot(we) / w.dot(we));
  const double along = clamped == at.signed_distance ? 1.0 - value.a_per_m : 1.0;
  sample.gradient = along * at.normal - shape.axes * shape.radii.cwiseQuotient(e).cwiseProduct(rest);
  return sample;
}

double score_of(const UnionField& field, const ReliefTables& relief, std::uint32_t k,
                const geometry::ClosestPoint& at) {
  const BakedTable& table = relief.tables[k];
  if (!relief.buries() || table.nodes < 2) return at.signed_distance;
  const auto [texel, u, v, half] = cell_of(table, unit_direction(field.shape(k), at));
  const std::uint8_t* const upper = relief.burial.data() + table.first_byte / 2 + texel;
  const std::uint8_t* const lower = upper + table.nodes;
  const double depth =
      (1 - v) * ((1 - u) * upper[0] + u * upper[1]) + v * ((1 - u) * lower[0] + u * lower[1]);
  return at.signed_distance + double{relief.burial_m} * depth;
}

namespace {

/// The ellipsoid of least score; the nearest one where burial does not count.
struct ScoredOwner {
  std::uint32_t ellipsoid = kNoEllipsoid;
  double score_m = std::numeric_limits<double>::infinity();
};

ScoredOwner owner_of(const UnionField& field, const ReliefTables& relief, const Vec3& p) {
  const Owner nearest = field.owner(p, std::numeric_limits<double>::infinity());
  if (nearest.ellipsoid == kNoEllipsoid || !relief.buries())
    return {nearest.ellipsoid, nearest.at.signed_distance};
  ScoredOwner owner = {nearest.ellipsoid, score_of(field, relief, nearest.ellipsoid, nearest.at)};
  if (!(owner.score_m > nearest.at.signed_distance)) return owner;
  field.visit_near(
      p, [&] { return owner.score_m; },
      [&](std::size_t index, const UnionField::Plane&) {
        const auto k = static_cast<std::uint32_t>(index);
        const double score_m = score_of(field, relief, k, geometry::closest_point(field.shape(index), p));
        if (score_m < owner.score_m) owner = {k, score_m};
      });
  return owner;
}

}  // namespace

ReliefSample relief_sample(const UnionField& field, const ReliefTables& relief, const Vec3& p) {
  const ScoredOwner owner = owner_of(field, relief, p);
  ReliefSample result{owner.score_m, Vec3::UnitX(), owner.ellipsoid};
  if (owner.ellipsoid == kNoEllipsoid) return result;
  const double least = owner.score_m, blend = double{relief.blend_m};
  double weights = 0.0, distance = 0.0;
  Vec3 gradient = Vec3::Zero();
  const auto add = [&](std::size_t k, const UnionField::Plane&) {
    const auto index = static_cast<std::uint32_t>(k);
    const geometry::ClosestPoint at = geometry::closest_point(field.shape(k), p);
    const double root = 1.0 - (score_of(field, relief, index, at) - least) / blend;
    if (!(root > 0.0)) return;
    const ReliefSample one = correct(field, relief, index, at);
    weights += root * root;
    distance += root * root * one.distance_m;
    gradient += root * root * one.gradient;
  };
  field.visit_near(
      p, [&] { return least + blend; }, add);
  result.distance_m = distance / weights;
  result.gradient = gradient / weights;
  return result;
}

}  // namespace bodice::collision
