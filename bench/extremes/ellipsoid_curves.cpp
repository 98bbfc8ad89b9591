#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <bodice/collision/collider.hpp>
#include <bodice/engine/random.hpp>

#include "curve.hpp"
#include "reference.hpp"

namespace extremes_bench {
namespace {

using namespace bodice;
using geometry::Ellipsoid;
using geometry::Vec3;

constexpr int kQueries = 2000;

Ellipsoid ellipsoid_at(const Placement& placement) {
  return {placement.center_m(), Placement::turn(), placement.extents_m()};
}

/// Query points. One half lies near the surface (a tenth of size_m at most), the other half reaches out to
/// 1.5 times the radii.
std::vector<Vec3> queries_at(const Ellipsoid& e, double size_m) {
  engine::Random random(2);
  std::vector<Vec3> queries;
  for (int i = 0; i < kQueries; ++i) {
    Vec3 u;
    for (int axis = 0; axis < 3; ++axis) u[axis] = random.normal();
    const Vec3 on = e.radii.cwiseProduct(u.normalized());
    const double away = random.uniform(-1.0, 1.0), far = random.uniform(0.0, 1.5);
    const Vec3 near = on + 0.1 * size_m * away * u.normalized();
    queries.push_back(e.center + e.axes * (i % 2 == 0 ? near : Vec3(far * on)));
  }
  return queries;
}

double nearest_error(const Placement& placement) {
  const Ellipsoid e = ellipsoid_at(placement);
  double worst = 0.0;
  for (const Vec3& q : queries_at(e, placement.scale_m))
    worst = std::max(worst, std::abs(geometry::closest_point(e, q).signed_distance - signed_distance(e, q)));
  return worst / placement.scale_m;
}

/// Points as the collider takes them: structure of arrays of floats relative to its origin.
struct Cloud {
  std::vector<float> x, y, z;

  Cloud(const std::vector<Vec3>& points, const Vec3& origin) {
    for (const Vec3& p : points) {
      const Eigen::Vector3f local = (p - origin).cast<float>();
      x.push_back(local.x()), y.push_back(local.y()), z.push_back(local.z());
    }
  }
  collision::Particles particles() {
    return {.count = x.size(), .x = x.data(), .y = y.data(), .z = z.data()};
  }
  Vec3 at(std::size_t i, const Vec3& origin) const {
    return origin + Vec3(double{x[i]}, double{y[i]}, double{z[i]});
  }
};

collision::Collider collider_of(const Ellipsoid& e) {
  proxy::BodyProxy::Data data;
  data.tier = proxy::Tier::kTight;
  data.stature_m = 2.0 * e.radii.maxCoeff();
  data.ellipsoids = {{e}};
  auto proxy = proxy::BodyProxy::make(std::move(data));
  if (!proxy) std::abort();  // a broken proxy would make every number here meaningless
  return collision::Collider(*proxy);
}

double query_error(const Placement& placement) {
  const Ellipsoid e = ellipsoid_at(placement);
  const auto collider = collider_of(e);
  Cloud cloud(queries_at(e, placement.scale_m), collider.origin());
  std::vector<collision::Contact> contacts(cloud.x.size());
  collider.query({}, cloud.particles(), contacts);
  double worst = 0.0;
  for (std::size_t i = 0; i < contacts.size(); ++i)
    worst = std::max(worst, std::abs(double{contacts[i].signed_distance} -
                                     signed_distance(e, cloud.at(i, collider.origin()))));
  return worst / placement.scale_m;
}

double depth_left(const Placement& placement) {
  const Ellipsoid e = ellipsoid_at(placement);
  const auto collider = collider_of(e);
  Cloud cloud(queries_at(e, placement.scale_m), collider.origin());
  collider.resolve({}, cloud.particles(), {});
  double worst = 0.0;
  for (std::size_t i = 0; i < cloud.x.size(); ++i)
    worst = std::max(worst, -signed_distance(e, cloud.at(i, collider.origin())));
  return worst / placement.scale_m;
}

}  // namespace

std::vector<Curve> ellipsoid_curves() {
  return {{"closest_point (double)", "distance, to size", nearest_error},
          {"Collider::query (float)", "distance, to size", query_error},
          {"Collider::resolve, nearest (float)", "depth left, to size", depth_left}};
}

}  // namespace extremes_bench
