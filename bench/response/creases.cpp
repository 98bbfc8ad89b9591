// Effect of creases on particles, with and without fillets. Measured are the largest jump of the contact
// normal between points a tenth of a millimeter apart, the motion of a particle at rest in a substep, and the
// costs of response and query.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include <bench_support/stopwatch.hpp>
#include <bodice/collision/collider.hpp>
#include <bodice/engine/random.hpp>

#include "modes.hpp"
#include "subjects.hpp"

namespace bench {

using namespace bodice;
using geometry::Vec3;

namespace {

constexpr int kPaths = 2000, kSteps = 200;
constexpr double kStep_m = 1e-4;

/// Particles with velocities.
struct Arrays {
  std::vector<float> x, y, z, vx, vy, vz;
  explicit Arrays(std::size_t count) : x(count), y(count), z(count), vx(count), vy(count), vz(count) {}
  collision::Particles view(bool with_velocity = true) {
    collision::Particles p{.count = x.size(), .x = x.data(), .y = y.data(), .z = z.data()};
    if (with_velocity) p.vx = vx.data(), p.vy = vy.data(), p.vz = vz.data();
    return p;
  }
  Vec3 position(std::size_t i) const { return {double{x[i]}, double{y[i]}, double{z[i]}}; }
  Vec3 velocity(std::size_t i) const { return {double{vx[i]}, double{vy[i]}, double{vz[i]}}; }
  void set(std::size_t i, const Vec3& p, const Vec3& v) {
    x[i] = static_cast<float>(p.x()), y[i] = static_cast<float>(p.y()), z[i] = static_cast<float>(p.z());
    vx[i] = static_cast<float>(v.x()), vy[i] = static_cast<float>(v.y()), vz[i] = static_cast<float>(v.z());
  }
};

std::vector<Vec3> on_surface(const proxy::BodyProxy& proxy, const collision::Collider& collider) {
  engine::Random random(9);
  std::vector<Vec3> points;
  while (points.size() < kPaths) {
    const auto& e = proxy.ellipsoids()[random.below(proxy.ellipsoids().size())].shape;
    const double a = random.normal(), b = random.normal();
    const Vec3 w = Vec3(a, b, random.normal()).stableNormalized();
    Arrays one(1);
    one.set(0, e.center + e.axes * e.radii.cwiseProduct(w) - collider.origin(), Vec3::Zero());
    collider.resolve({}, one.view(), {});
    points.push_back(one.position(0));
  }
  return points;
}

/// Quantiles of the angles between consecutive normals.
struct Jumps {
  double p99_deg = 0.0, p9999_deg = 0.0, largest_deg = 0.0;
};

/// Angles between the normals of consecutive points on paths over the surface.
Jumps normal_jumps(const collision::Collider& collider, const std::vector<Vec3>& points, float blend_m) {
  Arrays batch(points.size());
  std::vector<Vec3> at = points, direction(points.size()), last(points.size());
  engine::Random random(10);
  for (Vec3& d : direction) {
    const double a = random.normal(), b = random.normal();
    d = Vec3(a, b, random.normal()).stableNormalized();
  }
  std::vector<double> angles;
  for (int step = 0; step <= kSteps; ++step) {
    for (std::size_t i = 0; i < at.size(); ++i) {
      const float p[3] = {static_cast<float>(at[i].x()), static_cast<float>(at[i].y()),
                          static_cast<float>(at[i].z())};
      const collision::Contact c = collider.query(p);
      const Vec3 n(double{c.normal[0]}, double{c.normal[1]}, double{c.normal[2]});
      batch.set(i, at[i] - 2e-4 * n, -n);
    }
    collider.resolve({}, batch.view(), {.friction = 0.0f, .blend_m = blend_m});
    for (std::size_t i = 0; i < at.size(); ++i) {
      const float p[3] = {static_cast<float>(at[i].x()), static_cast<float>(at[i].y()),
                          static_cast<float>(at[i].z())};
      const collision::Contact c = collider.query(p);
      const Vec3 inward(-double{c.normal[0]}, -double{c.normal[1]}, -double{c.normal[2]});
      const Vec3 push = batch.velocity(i) - inward;
      if (push.norm() > 0.1) {
        const Vec3 n = push.normalized();
        if (last[i].squaredNorm() > 0.5)
          angles.push_back(std::acos(std::clamp(n.dot(last[i]), -1.0, 1.0)) * 180.0 / 3.14159265358979);
        last[i] = n;
      }
      const Vec3 n = last[i].squaredNorm() > 0.5 ? last[i] : Vec3(-inward);
      const Vec3 along = direction[i] - n.dot(direction[i]) * n;
      at[i] = batch.position(i) + kStep_m * along.stableNormalized();
    }
  }
  std::sort(angles.begin(), angles.end());
  const auto quantile = [&](double q) {
    return angles[static_cast<std::size_t>(q * static_cast<double>(angles.size() - 1))];
  };
  return {quantile(0.99), quantile(0.9999), angles.back()};
}

/// Motion in the last substep of particles that are pressed on the surface, with the friction of cotton:
/// median and 99th percentile.
std::pair<double, double> chatter_um(const collision::Collider& collider, const std::vector<Vec3>& points,
                                     float blend_m) {
  constexpr double kSubstep_s = 1.0 / 960.0;
  Arrays batch(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) batch.set(i, points[i], Vec3::Zero());
  std::vector<Vec3> pressed(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const float p[3] = {batch.x[i], batch.y[i], batch.z[i]};
    const collision::Contact c = collider.query(p);
    pressed[i] = -9.81 * Vec3(double{c.normal[0]}, double{c.normal[1]}, double{c.normal[2]});
  }
  std::vector<double> moved;
  for (int step = 0; step < 300; ++step) {
    const Arrays before = batch;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec3 v = batch.velocity(i) + kSubstep_s * pressed[i];
      batch.set(i, batch.position(i) + kSubstep_s * v, v);
    }
    collider.resolve({}, batch.view(), {.friction = 0.5f, .blend_m = blend_m});
    moved.clear();
    for (std::size_t i = 0; i < points.size(); ++i)
      moved.push_back(1e6 * (batch.position(i) - before.position(i)).norm());
  }
  std::sort(moved.begin(), moved.end());
  return {moved[moved.size() / 2], moved[moved.size() * 99 / 100]};
}

/// Least nanoseconds a particle of a query and of a response, over the same coherent cloud near the surface.
std::pair<double, double> cost_ns(const collision::Collider& collider, const std::vector<Vec3>& points,
                                  float blend_m) {
  engine::Random random(3);
  Arrays cloud(100000);
  for (std::size_t i = 0; i < cloud.x.size(); ++i) {
    const double a = random.uniform(-0.03, 0.03), b = random.uniform(-0.03, 0.03);
    cloud.set(i, points[random.below(points.size())] + Vec3(a, b, random.uniform(-0.03, 0.03)), Vec3::Zero());
  }
  std::vector<collision::Contact> contacts(cloud.x.size());
  collision::Workspace order;
  double query = 1e9, response = 1e9;
  Arrays moved = cloud;
  for (int repeat = 0; repeat < 25; ++repeat) {
    const bench::Stopwatch queried;
    collider.query({}, cloud.view(false), contacts, order);
    query = std::min(query, queried.cpu_ms());
    moved = cloud;
    const bench::Stopwatch pushed;
    collider.resolve({}, moved.view(false), {.blend_m = blend_m}, order);
    response = std::min(response, pushed.cpu_ms());
  }
  const double per = 1e6 / static_cast<double>(cloud.x.size());
  return {query * per, response * per};
}

}  // namespace

bool cross_creases(std::span<char*>) {
  std::printf(
      "| tier | blend mm | normal jump in 0.1 mm, deg: 99 %% | 99.99 %% | most | chatter um a substep: "
      "median | "
      "99 %% | query ns | response ns | ratio (bar 2, without fillets) "
      "|\n|---|---|---|---|---|---|---|---|---|---|\n");
  bool good = true;
  for (const proxy::Tier tier : {proxy::Tier::kSolid, proxy::Tier::kTight, proxy::Tier::kRelief}) {
    const proxy::BodyProxy proxy = fit_body(synth::Pose::kA, 0, tier);
    const collision::Collider collider(proxy);
    const std::vector<Vec3> points = on_surface(proxy, collider);
    for (const float blend_m : {0.0f, 0.003f, 0.01f}) {
      if (tier == proxy::Tier::kRelief && blend_m > 0.0f) continue;  // blends by itself
      const Jumps jumps = normal_jumps(collider, points, blend_m);
      const auto [chatter, chatter99] = chatter_um(collider, points, blend_m);
      const auto [query, response] = cost_ns(collider, points, blend_m);
      std::printf("| %s | %.0f | %.2f | %.2f | %.1f | %.2f | %.2f | %.1f | %.1f | %.2f |\n",
                  std::string(proxy::name(tier)).c_str(), 1e3 * double{blend_m}, jumps.p99_deg,
                  jumps.p9999_deg, jumps.largest_deg, chatter, chatter99, query, response, response / query);
      std::fflush(stdout);
      good = good && (blend_m > 0.0f || response < 2.0 * query);
    }
  }
  return good;
}

}  // namespace bench
