#include <cmath>
#include <limits>

#include <bodice/collision/collider.hpp>
#include <bodice/proxy/proxy_distance.hpp>
#include <bodice/proxy/proxy_file.hpp>
#include <bodice_test/extremes.hpp>
#include <bodice_test/responses.hpp>

#include "rows.hpp"

namespace extremes {
namespace {

using namespace bodice;
using bodice_test::EllipsoidCase;
using bodice_test::leaves_none_inside;
using geometry::Ellipsoid;
using geometry::Vec3;

/// Queries as floats in the collider's frame, and their positions in the world.
struct Cloud {
  std::vector<float> x, y, z, vx, vy, vz;
  std::vector<Vec3> world;

  Cloud(const std::vector<Vec3>& points, const Vec3& origin) {
    for (const Vec3& p : points) {
      const Eigen::Vector3f local = (p - origin).cast<float>();
      x.push_back(local.x()), y.push_back(local.y()), z.push_back(local.z());
      world.push_back(origin + local.cast<double>());
    }
    for (auto* v : {&vx, &vy, &vz}) v->assign(x.size(), 1.0f);
  }
  collision::Particles particles() {
    return {x.size(), x.data(), y.data(), z.data(), vx.data(), vy.data(), vz.data()};
  }
  Vec3 at(std::size_t i, const Vec3& origin) const { return origin + Vec3(x[i], y[i], z[i]); }
};

proxy::BodyProxy proxy_of(const Ellipsoid& shape) {
  proxy::BodyProxy::Data data;
  data.tier = proxy::Tier::kTight;
  data.stature_m = 2.0 * shape.radii.maxCoeff();
  data.ellipsoids = {{shape}};
  return proxy::BodyProxy::make(std::move(data)).value();
}

/// The bound for floats: 3e-7 of the largest coordinate in the ellipsoid's frame.
double float_tolerance_m(const Ellipsoid& shape, const Vec3& point) {
  return 2e-6 * (shape.radii.maxCoeff() + (point - shape.center).norm());
}

std::string check_nearest(const EllipsoidCase& c) {
  const Ellipsoid& e = c.shape;
  for (const Vec3& q : bodice_test::hostile_queries(e)) {
    const auto found = geometry::closest_point(e, q);
    if (!found.point.allFinite() || !found.normal.allFinite() || !std::isfinite(found.signed_distance))
      return "not finite";
    const double size = e.radii.maxCoeff() + (q - e.center).norm() + 1e-3 * e.center.norm();
    if (std::abs((q - found.point).norm() - std::abs(found.signed_distance)) > 1e-11 * size)
      return "distance and point disagree";
    if (std::abs(found.normal.norm() - 1.0) > 1e-9) return "the normal has no unit length";
    // No point of the surface along the ray is nearer.
    const double ray = (geometry::radial_projection(e, q) - q).norm();
    if (std::abs(found.signed_distance) > ray + 1e-11 * size) return "the ray's end is nearer";
  }
  return {};
}

std::string check_query(const EllipsoidCase& c) {
  const proxy::BodyProxy proxy = proxy_of(c.shape);
  const collision::Collider collider(proxy);
  Cloud cloud(bodice_test::hostile_queries(c.shape), collider.origin());
  std::vector<collision::Contact> contacts(cloud.x.size());
  collider.query({}, cloud.particles(), contacts);
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const double d = static_cast<double>(contacts[i].signed_distance);
    if (!std::isfinite(d)) return "not finite";
    const double error = std::abs(d - proxy::proxy_distance(proxy, cloud.world[i]).distance);
    if (error > float_tolerance_m(c.shape, cloud.world[i]))
      return "distance off by " + std::to_string(error / c.shape.radii.maxCoeff()) + " of the longest radius";
  }
  return {};
}

std::string check_resolve(const EllipsoidCase& c, collision::Response response) {
  const proxy::BodyProxy proxy = proxy_of(c.shape);
  const collision::Collider collider(proxy);
  Cloud cloud(bodice_test::hostile_queries(c.shape), collider.origin());
  const auto report = collider.resolve({}, cloud.particles(), {.response = response});
  if (report.not_finite != 0) return "finite particles were left alone";
  if (leaves_none_inside(response) && report.unresolved != 0) return "unresolved";
  for (std::size_t i = 0; i < cloud.x.size(); ++i) {
    const Vec3 p = cloud.at(i, collider.origin());
    if (!p.allFinite() || !std::isfinite(cloud.vx[i] + cloud.vy[i] + cloud.vz[i])) return "not finite";
    const double depth = -proxy::proxy_distance(proxy, p).distance;
    if (depth > float_tolerance_m(c.shape, p))
      return "still inside by " + std::to_string(depth / c.shape.radii.maxCoeff()) + " of the longest radius";
  }
  return {};
}

std::string check_file(const EllipsoidCase& c) {
  const proxy::BodyProxy proxy = proxy_of(c.shape);
  const auto bytes = proxy::to_binary(proxy);
  const auto back = proxy::from_binary(bytes);
  if (!back.ok()) return back.error().message;
  return expect(back->hash() == proxy.hash(), "another hash after the file");
}

}  // namespace

std::vector<Row> ellipsoid_rows() {
  std::vector<Row> rows;
  for (const EllipsoidCase& c : bodice_test::extreme_ellipsoids()) {
    rows.push_back({"closest_point (double)", c.name, [&c] { return check_nearest(c); }});
    rows.push_back({"Collider::query (float)", c.name, [&c] { return check_query(c); }});
    for (const auto& [name, response] : bodice_test::kResponses)
      rows.push_back({std::string("Collider::resolve, ") + name, c.name,
                      [&c, response] { return check_resolve(c, response); }});
    rows.push_back({"proxy file", c.name, [&c] { return check_file(c); }});
  }
  return rows;
}

}  // namespace extremes
