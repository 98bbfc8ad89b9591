#include <bench_references/subject.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include <Eigen/Geometry>

#include <bodice/engine/random.hpp>

namespace bench {

using bodice::geometry::Vec3;

namespace {

std::uint64_t morton(const Vec3& p) {
  std::uint64_t key = 0;
  for (int bit = 0; bit < 12; ++bit)
    for (int axis = 0; axis < 3; ++axis) {
      const auto cell = static_cast<std::uint64_t>((p[axis] + 4.0) * 500.0);  // 2 mm
      key |= (cell >> bit & 1) << (3 * bit + axis);
    }
  return key;
}

}  // namespace

void Cloud::add(const Vec3& p) {
  x.push_back(static_cast<float>(p.x()));
  y.push_back(static_cast<float>(p.y()));
  z.push_back(static_cast<float>(p.z()));
}

bodice::synth::Body make_subject(int vertices) {
  bodice::synth::BodyOptions options;
  options.vertices = vertices;
  auto body = bodice::synth::make_body({}, options);
  if (!body.ok()) throw std::runtime_error(body.error().sentence());
  return std::move(body).value();
}

bodice::proxy::BodyProxy fit_subject(const bodice::synth::Body& body,
                                     const bodice::geometry::MeshDistance& skin, bodice::proxy::Tier tier,
                                     int ellipsoids, double seconds) {
  bodice::fitting::FitOptions options;
  options.tier = tier;
  options.max_ellipsoids = ellipsoids;
  options.time_budget_s = seconds;
  auto result = bodice::fitting::fit(
      {}, {.mesh = body.mesh, .part = body.part, .stature_m = body.stature_m, .distance = &skin}, options);
  if (!result.ok()) throw std::runtime_error(result.error().sentence());
  return result->proxy;
}

Cloud near_skin(const bodice::geometry::TriMesh& mesh, std::size_t count, double band_m, std::uint64_t seed) {
  std::vector<double> area;
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.positions[t[0]], b = mesh.positions[t[1]], c = mesh.positions[t[2]];
    area.push_back((area.empty() ? 0.0 : area.back()) + 0.5 * (b - a).cross(c - a).norm());
  }
  bodice::engine::Random random(seed);
  Cloud cloud;
  for (std::size_t i = 0; i < count; ++i) {
    const double pick = random.uniform(0.0, area.back());
    const auto k = static_cast<std::size_t>(std::lower_bound(area.begin(), area.end(), pick) - area.begin());
    const auto& t = mesh.triangles[std::min(k, area.size() - 1)];
    const Vec3 a = mesh.positions[t[0]], b = mesh.positions[t[1]], c = mesh.positions[t[2]];
    double u = random.uniform(), v = random.uniform();
    if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
    const Vec3 normal = (b - a).cross(c - a).stableNormalized();
    cloud.add(a + u * (b - a) + v * (c - a) + random.uniform(-band_m, band_m) * normal);
  }
  return cloud;
}

Cloud coherent(const Cloud& cloud) {
  std::vector<std::pair<std::uint64_t, std::size_t>> order;
  for (std::size_t i = 0; i < cloud.size(); ++i) order.emplace_back(morton(cloud.at(i)), i);
  std::sort(order.begin(), order.end());
  Cloud result;
  for (const auto& [key, i] : order) result.add(cloud.at(i));
  return result;
}

Cloud local(const Cloud& cloud, const bodice::collision::Collider& collider) {
  Cloud result;
  for (std::size_t i = 0; i < cloud.size(); ++i) result.add(cloud.at(i) - collider.origin());
  return result;
}

}  // namespace bench
