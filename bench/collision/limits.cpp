#include "limits.hpp"

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <utility>

#include <bodice/engine/random.hpp>
#include <bodice/geometry/ellipsoid.hpp>

namespace bench {
namespace {

using bodice::geometry::Ellipsoid;
using bodice::geometry::Vec3;

const bodice::proxy::ProxyEllipsoid& largest(const bodice::proxy::BodyProxy& proxy) {
  const auto volume = [](const auto& e) { return e.shape.radii.prod(); };
  const auto& all = proxy.ellipsoids();
  return *std::max_element(all.begin(), all.end(),
                           [&](const auto& a, const auto& b) { return volume(a) < volume(b); });
}

bodice::proxy::BodyProxy alone(const bodice::proxy::BodyProxy& proxy) {
  auto one = bodice::proxy::BodyProxy::make(
      {.tier = bodice::proxy::Tier::kSolid, .stature_m = proxy.stature_m(), .ellipsoids = {largest(proxy)}});
  if (!one.ok()) throw std::runtime_error(one.error().sentence());
  return *one;
}

Cloud around(const Ellipsoid& e, std::size_t count, double band_m) {
  const bodice::engine::Random random(5);
  Cloud cloud;
  std::uint64_t draw = 0;
  const auto number = [&] { return 2.0 * random.uniform_at(draw++) - 1.0; };
  while (cloud.size() < count) {
    Vec3 direction;
    for (double& c : direction) c = number();
    if (direction.norm() > 1.0 || direction.norm() < 0.1) continue;
    direction.normalize();
    const Vec3 normal = direction.cwiseQuotient(e.radii).normalized();
    cloud.add(e.center + e.axes * (direction.cwiseProduct(e.radii) + band_m * number() * normal));
  }
  return coherent(cloud);
}

}  // namespace

Limits::Limits(const bodice::proxy::BodyProxy& proxy, std::size_t particles, double band_m)
    : one_(alone(proxy)),
      frames_(local(around(largest(proxy).shape, particles, band_m), one_)),
      contacts_(particles) {}

void Limits::move_bytes() {
  const Cloud& cloud = frames_.now();
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    bodice::collision::Contact& c = contacts_[i];
    c.signed_distance = c.normal[0] = cloud.x[i];
    c.point[0] = c.normal[1] = cloud.y[i];
    c.point[1] = c.normal[2] = cloud.z[i];
    c.point[2] = 0.0f;
    c.ellipsoid = static_cast<std::uint32_t>(i);
  }
}

void Limits::add_to(std::vector<Row>& rows) {
  const auto n = static_cast<double>(contacts_.size());
  const auto add = [&](const char* name, std::function<void()> work) {
    rows.push_back({name, std::move(work), n, 0.0, [this] { frames_.step(); }, kFrameCalls});
  };
  add("limit: positions read, contacts written", [this] { move_bytes(); });
  add("limit: one ellipsoid, a closest point a particle, frames",
      [this] { one_.query({}, frames_.now().particles(), contacts_, frames_.workspace); });
}

}  // namespace bench
