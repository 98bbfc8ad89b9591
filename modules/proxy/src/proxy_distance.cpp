#include <bodice/proxy/proxy_distance.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace bodice::proxy {
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
};

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
  const Vec3 w = (e.axes.transpose() * (c.closest.point - e.center)).cwiseQuotient(e.radii).normalized();
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

/// A lower bound on the signed distance: by the enclosing sphere, and because the map from the unit sphere
/// stretches lengths by a factor between the least and the largest radius.
double lower_bound(const geometry::Ellipsoid& e, const Vec3& point) {
  constexpr double kRounding = 1e-12;
  const Vec3 p = point - e.center;
  const double shortest = e.radii.minCoeff(), longest = e.radii.maxCoeff();
  const double beyond = (e.axes.transpose() * p).cwiseQuotient(e.radii).norm() - 1.0;
  const double length = p.norm();
  return std::max(length - longest, beyond * (beyond > 0.0 ? shortest : longest)) -
         kRounding * (length + longest);
}

/// The owner of a point, with its plain distance and normal, and the ellipsoids that are blended there.
struct NearEllipsoids {
  ProxyDistance owner;
  std::vector<Candidate> blended;
};

/// Finds the owner, and with `blend_m` above zero all ellipsoids at most that much farther than the owner.
/// Some of the found ellipsoids may be farther; their weight is zero.
NearEllipsoids find_near(std::span<const ProxyEllipsoid> ellipsoids, const Vec3& point, double blend_m) {
  std::vector<double> bound;
  bound.reserve(ellipsoids.size());
  for (const ProxyEllipsoid& e : ellipsoids) bound.push_back(lower_bound(e.shape, point));
  // The ellipsoid of the least bound is evaluated first, because few others then have a bound below it.
  const auto first = static_cast<std::size_t>(std::ranges::min_element(bound) - bound.begin());
  const geometry::ClosestPoint first_closest = geometry::closest_point(ellipsoids[first].shape, point);
  double least = first_closest.signed_distance;
  NearEllipsoids near;
  near.owner.distance = std::numeric_limits<double>::infinity();
  for (std::uint32_t k = 0; k < ellipsoids.size(); ++k) {
    if (k != first && bound[k] > least + blend_m) continue;
    const geometry::ClosestPoint closest =
        k == first ? first_closest : geometry::closest_point(ellipsoids[k].shape, point);
    least = std::min(least, closest.signed_distance);
    if (closest.signed_distance < near.owner.distance)
      near.owner = {.distance = closest.signed_distance, .normal = closest.normal, .owner = k};
    if (blend_m > 0.0) near.blended.push_back({closest, k});
  }
  return near;
}

/// Eq. (5) with tables, without the margin.
ProxyDistance blend(const NearEllipsoids& near, std::span<const ProxyEllipsoid> ellipsoids,
                    std::span<const ReliefTable> relief, std::span<const ReliefTexel> texels,
                    const ReliefReach& reach) {
  double weights = 0.0, sum = 0.0;
  Vec3 gradient = Vec3::Zero();
  for (const Candidate& c : near.blended) {
    const double ramp =
        std::max(0.0, 1.0 - (c.closest.signed_distance - near.owner.distance) / reach.blend_m);
    if (ramp == 0.0) continue;
    const Corrected f = corrected(ellipsoids[c.index].shape, c, relief[c.index], texels, reach);
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

ProxyDistance evaluate(std::span<const ProxyEllipsoid> ellipsoids, std::span<const ReliefTable> relief,
                       std::span<const ReliefTexel> texels, double stature_m, double margin_m,
                       const Vec3& point) {
  if (ellipsoids.empty()) return {.distance = std::numeric_limits<double>::infinity()};
  const ReliefReach reach = relief_reach(stature_m);
  const NearEllipsoids near = find_near(ellipsoids, point, relief.empty() ? 0.0 : reach.blend_m);
  ProxyDistance result = relief.empty() ? near.owner : blend(near, ellipsoids, relief, texels, reach);
  result.distance -= margin_m;
  return result;
}

}  // namespace

ReliefReach relief_reach(double stature_m) {
  constexpr double kReferenceStature_m = 1.70;
  constexpr ReliefReach kReference{0.030, 0.030, 0.003};
  const double scale = stature_m > 0.0 ? stature_m / kReferenceStature_m : 1.0;
  return {kReference.in_m * scale, kReference.out_m * scale, kReference.blend_m * scale};
}

ProxyDistance proxy_distance(const BodyProxy& proxy, const Vec3& point) {
  return evaluate(proxy.ellipsoids(), proxy.relief(), proxy.texels(), proxy.stature_m(), proxy.margin_m(),
                  point);
}

ProxyDistance proxy_distance(const BodyProxy::Data& data, const Vec3& point) {
  return evaluate(data.ellipsoids, data.relief, data.texels, data.stature_m, data.margin_m, point);
}

}  // namespace bodice::proxy
