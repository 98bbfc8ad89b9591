#include <bodice/proxy/proxy_distance.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include <bodice/proxy/posed_proxy.hpp>

namespace bodice::inline v0_1::proxy {
namespace {

/// A table's values at a direction, with their derivatives.
struct TableValue {
  double h = 0.0, a = 0.0;
  Vec3 dh = Vec3::Zero(), da = Vec3::Zero();  ///< with respect to w; the radial part is undefined
};

/// The derivative of the octahedral map at a unit vector w: rows x and y, radial part included.
Eigen::Matrix<double, 2, 3> map_jacobian(const Vec3& w) {
  const double s = w.cwiseAbs().sum();
  const Vec3 sign = w.unaryExpr([](double v) { return v < 0.0 ? -1.0 : 1.0; });
  Eigen::Matrix<double, 2, 3> j;
  for (int row = 0; row < 2; ++row) j.row(row) = (Vec3::Unit(row) / s - w[row] / (s * s) * sign).transpose();
  if (w.z() >= 0.0) return j;
  Eigen::Matrix<double, 2, 3> folded;  // p_x = (1 - |q_y|) sign(q_x), and the same for p_y
  folded.row(0) = -sign[0] * sign[1] * j.row(1);
  folded.row(1) = -sign[0] * sign[1] * j.row(0);
  return folded;
}

TableValue read(const ReliefTable& table, std::span<const ReliefTexel> texels, const Vec3& w) {
  const int n = table.nodes_per_side;
  const TableStencil stencil = table_stencil(w, n);
  std::array<double, 4> h, a;
  TableValue value;
  for (int k = 0; k < 4; ++k) {
    const ReliefTexel texel = texels[table.first_texel + stencil.node[k]];
    h[k] = static_cast<double>(table.h_offset_m) + static_cast<double>(table.h_scale_m) * texel.h / 255.0;
    a[k] = static_cast<double>(table.a_offset) + static_cast<double>(table.a_scale) * texel.a / 255.0;
    value.h += stencil.weight[k] * h[k];
    value.a += stencil.weight[k] * a[k];
  }
  const double s = stencil.weight[1] + stencil.weight[3], t = stencil.weight[2] + stencil.weight[3];
  const double per_unit = 0.5 * (n - 1);
  const auto gradient = [&](const std::array<double, 4>& f) {
    return Eigen::RowVector2d(per_unit * ((1.0 - t) * (f[1] - f[0]) + t * (f[3] - f[2])),
                              per_unit * ((1.0 - s) * (f[2] - f[0]) + s * (f[3] - f[1])));
  };
  const Eigen::Matrix<double, 2, 3> jacobian = map_jacobian(w);
  value.dh = (gradient(h) * jacobian).transpose();
  value.da = (gradient(a) * jacobian).transpose();
  return value;
}

/// An ellipsoid near a point, with its closest point.
struct Candidate {
  geometry::ClosestPoint closest;
  std::uint32_t index = 0;
  double score = 0.0;  ///< d_k, or d_k + kappa b_k of a posed proxy
};

/// w of eq. (2).
Vec3 unit_direction(const geometry::Ellipsoid& e, const geometry::ClosestPoint& closest) {
  return (e.axes.transpose() * (closest.point - e.center)).cwiseQuotient(e.radii).normalized();
}

/// An ellipsoid's distance with its table, and its gradient.
struct Corrected {
  double distance = 0.0;
  Vec3 gradient = Vec3::Zero();
};

/// Eq. (3) and its gradient: n (1 - a clamp'/out) - D (G - w (G . (w / e)) / sum(w^2 / e)).
Corrected corrected(const geometry::Ellipsoid& e, const Candidate& c, const ReliefTable& table,
                    std::span<const ReliefTexel> texels, const ReliefReach& reach) {
  const double d = c.closest.signed_distance;
  if (table.nodes_per_side < 2) return {d, c.closest.normal};
  const Vec3 w = unit_direction(e, c.closest);
  const TableValue value = read(table, texels, w);
  const double clamped = std::clamp(d, -reach.in_m, reach.out_m);
  const bool slopes = d > -reach.in_m && d < reach.out_m;
  const double t = d / w.cwiseQuotient(e.radii).norm();  // x - f_k = t w / r in the ellipsoid's frame
  const Vec3 evolute = (e.radii.cwiseAbs2().array() + t).matrix();
  const Vec3 n = e.axes.transpose() * c.closest.normal;
  const Vec3 g = value.dh + clamped / reach.out_m * value.da;
  Vec3 local = n * (1.0 - (slopes ? value.a / reach.out_m : 0.0));
  const Vec3 w_e = w.cwiseQuotient(evolute);
  const double along = w.dot(w_e);
  if (evolute.minCoeff() > 1e-9 * e.radii.cwiseAbs2().maxCoeff() && along > 0.0)
    local -= e.radii.cwiseQuotient(evolute).cwiseProduct(g - w * (g.dot(w_e) / along));
  return {d - value.h - value.a * clamped / reach.out_m, e.axes * local};
}

constexpr double kRounding = 1e-12;

/// A lower bound on the signed distance by the enclosing sphere.
double sphere_bound(const geometry::Ellipsoid& e, const Vec3& point) {
  const double longest = e.radii.maxCoeff(), length = (point - e.center).norm();
  return length - longest - kRounding * (length + longest);
}

/// A lower bound on the signed distance, never below the sphere's: the map from the unit sphere stretches
/// lengths by a factor between the least and the largest radius.
double lower_bound(const geometry::Ellipsoid& e, const Vec3& point) {
  const Vec3 p = point - e.center;
  const double shortest = e.radii.minCoeff(), longest = e.radii.maxCoeff();
  const double beyond = (e.axes.transpose() * p).cwiseQuotient(e.radii).norm() - 1.0;
  const double length = p.norm();
  return std::max(length - longest, beyond * (beyond > 0.0 ? shortest : longest)) -
         kRounding * (length + longest);
}

/// The ellipsoids and tables of a proxy, at rest or posed.
struct Surfaces {
  const geometry::Ellipsoid* first = nullptr;
  std::size_t stride = 1, count = 0;  ///< stride in bytes
  std::span<const ReliefTable> relief;
  std::span<const ReliefTexel> texels;
  std::span<const std::uint8_t> burial;  ///< empty at rest
  double burial_step_m = 0.0;
  ReliefReach reach;

  const geometry::Ellipsoid& shape(std::size_t k) const {
    return *reinterpret_cast<const geometry::Ellipsoid*>(reinterpret_cast<const std::byte*>(first) +
                                                         k * stride);
  }
  /// kappa b_k of eq. (4') at the closest point.
  double burial_of(std::size_t k, const geometry::ClosestPoint& closest) const {
    if (burial.empty() || relief[k].nodes_per_side < 2) return 0.0;
    const geometry::Ellipsoid& e = shape(k);
    const TableStencil stencil = table_stencil(unit_direction(e, closest), relief[k].nodes_per_side);
    double depth = 0.0;
    for (int i = 0; i < 4; ++i) depth += stencil.weight[i] * burial[relief[k].first_texel + stencil.node[i]];
    return kBurialWeight * burial_step_m * depth;
  }
};

/// The owner of a point, with its plain distance and normal, and the ellipsoids that are blended there.
struct NearEllipsoids {
  ProxyDistance owner;
  double least = std::numeric_limits<double>::infinity();  ///< left side of eq. (4') for the owner
  std::vector<Candidate> blended;
};

/// Finds the owner, and with `blend_m` above zero all ellipsoids at most that much farther than the owner.
/// Some of the found ellipsoids may be farther; their weight is zero.
NearEllipsoids find_near(const Surfaces& surfaces, const Vec3& point, double blend_m) {
  std::vector<double> bound;  // the sphere's where that is enough to know that an ellipsoid is not the first
  bound.reserve(surfaces.count);
  // The ellipsoid of the least bound is evaluated first, because few others then have a bound below it.
  std::size_t first = 0;
  double least_bound = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < surfaces.count; ++k) {
    bound.push_back(sphere_bound(surfaces.shape(k), point));
    if (bound[k] > least_bound) continue;
    bound[k] = lower_bound(surfaces.shape(k), point);
    if (bound[k] < least_bound) first = k, least_bound = bound[k];
  }
  const auto candidate = [&](std::size_t k) {
    Candidate c{geometry::closest_point(surfaces.shape(k), point), static_cast<std::uint32_t>(k)};
    c.score = c.closest.signed_distance + surfaces.burial_of(k, c.closest);
    return c;
  };
  const Candidate first_candidate = candidate(first);
  double least = first_candidate.score;
  NearEllipsoids near;
  for (std::size_t k = 0; k < surfaces.count; ++k) {
    const double reach = least + blend_m;
    if (k != first && (bound[k] > reach || lower_bound(surfaces.shape(k), point) > reach)) continue;
    const Candidate c = k == first ? first_candidate : candidate(k);
    least = std::min(least, c.score);
    if (c.score < near.least) {
      near.least = c.score;
      near.owner = {.distance = c.closest.signed_distance, .normal = c.closest.normal, .owner = c.index};
    }
    if (blend_m > 0.0) near.blended.push_back(c);
  }
  return near;
}

/// Eq. (5) or (5') with tables, without the margin.
ProxyDistance blend(const NearEllipsoids& near, const Surfaces& surfaces) {
  double weights = 0.0, sum = 0.0;
  Vec3 gradient = Vec3::Zero();
  for (const Candidate& c : near.blended) {
    const double ramp = std::max(0.0, 1.0 - (c.score - near.least) / surfaces.reach.blend_m);
    if (ramp == 0.0) continue;
    const Corrected f =
        corrected(surfaces.shape(c.index), c, surfaces.relief[c.index], surfaces.texels, surfaces.reach);
    weights += ramp * ramp;
    sum += ramp * ramp * f.distance;
    gradient += ramp * ramp * f.gradient;
  }
  ProxyDistance result = near.owner;
  result.distance = sum / weights;
  const double length = gradient.norm();
  if (length > 0.0) result.normal = gradient / length;
  return result;
}

ProxyDistance evaluate(const Surfaces& surfaces, double margin_m, const Vec3& point) {
  if (surfaces.count == 0) return {.distance = std::numeric_limits<double>::infinity()};
  const bool tables = !surfaces.relief.empty();
  const NearEllipsoids near = find_near(surfaces, point, tables ? surfaces.reach.blend_m : 0.0);
  ProxyDistance result = tables ? blend(near, surfaces) : near.owner;
  result.distance -= margin_m;
  return result;
}

ProxyDistance evaluate_at_rest(std::span<const ProxyEllipsoid> ellipsoids,
                               std::span<const ReliefTable> relief, std::span<const ReliefTexel> texels,
                               const BodyProxy::Data& sizes, const Vec3& point) {
  Surfaces surfaces;
  surfaces.first = ellipsoids.empty() ? nullptr : &ellipsoids[0].shape;
  surfaces.stride = sizeof(ProxyEllipsoid);
  surfaces.count = ellipsoids.size();
  surfaces.relief = relief;
  surfaces.texels = texels;
  surfaces.reach = relief_reach(sizes.stature_m);
  return evaluate(surfaces, sizes.margin_m, point);
}

}  // namespace

ProxyDistance proxy_distance(const BodyProxy& proxy, const Vec3& point) {
  return proxy_distance(proxy.data(), point);
}

ProxyDistance proxy_distance(const BodyProxy::Data& data, const Vec3& point) {
  return evaluate_at_rest(data.ellipsoids, data.relief, data.texels, data, point);
}

ProxyDistance posed_proxy_distance(const BodyProxy& bound, const PosedProxy& posed, const Vec3& point) {
  Surfaces surfaces;
  surfaces.first = posed.shapes.data();
  surfaces.stride = sizeof(geometry::Ellipsoid);
  surfaces.count = posed.shapes.size();
  surfaces.relief = posed.relief;
  surfaces.texels = posed.texels;
  surfaces.burial = posed.burial;
  surfaces.burial_step_m = double{posed.burial_step_m};
  surfaces.reach = relief_reach(bound.stature_m() * posed.scale);
  return evaluate(surfaces, bound.margin_m() * posed.scale, point);
}

}  // namespace bodice::proxy
