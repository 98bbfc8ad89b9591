#include <bench_references/capsules.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Eigenvalues>

// The capsules get the same vector instructions as the kernels of bodice.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define BENCH_VECTOR_CLONES __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define BENCH_VECTOR_CLONES
#endif

namespace bench {

using bodice::geometry::Mat3;
using bodice::geometry::Vec3;

Capsule capsule_around(const std::vector<Vec3>& points) {
  const auto count = static_cast<double>(points.size());
  Vec3 mean = Vec3::Zero();
  for (const Vec3& p : points) mean += p / count;
  Mat3 spread = Mat3::Zero();
  for (const Vec3& p : points) spread += (p - mean) * (p - mean).transpose();
  const Vec3 axis = Eigen::SelfAdjointEigenSolver<Mat3>(spread).eigenvectors().col(2);
  std::vector<double> aside;
  double low = 0.0, high = 0.0;
  for (const Vec3& p : points) {
    const double along = (p - mean).dot(axis);
    low = std::min(low, along), high = std::max(high, along);
    aside.push_back((p - mean - along * axis).norm());
  }
  const auto middle = aside.begin() + static_cast<std::ptrdiff_t>(aside.size() / 2);
  std::nth_element(aside.begin(), middle, aside.end());
  const double radius = *middle;
  low = std::min(low + radius, 0.0), high = std::max(high - radius, 0.0);
  const Vec3 start = mean + low * axis, along = (high - low) * axis;
  Capsule capsule{};
  for (int k = 0; k < 3; ++k)
    capsule.start[k] = static_cast<float>(start[k]), capsule.along[k] = static_cast<float>(along[k]);
  capsule.inverse_squared_length = high > low ? static_cast<float>(1.0 / along.squaredNorm()) : 0.0f;
  capsule.radius = static_cast<float>(radius);
  return capsule;
}

std::vector<Capsule> fit_capsules(const bodice::geometry::TriMesh& mesh,
                                  std::span<const bodice::body::Part> part) {
  std::vector<Capsule> capsules;
  for (int p = 0; p < bodice::body::kPartCount; ++p) {
    std::vector<Vec3> points;
    for (std::size_t v = 0; v < part.size(); ++v)
      if (static_cast<int>(part[v]) == p) points.push_back(mesh.positions[v]);
    if (!points.empty()) capsules.push_back(capsule_around(points));
  }
  return capsules;
}

BENCH_VECTOR_CLONES
void capsule_distances(std::span<const Capsule> capsules, const Cloud& particles,
                       std::span<float> distance_m) {
  std::fill(distance_m.begin(), distance_m.end(), std::numeric_limits<float>::infinity());
  const std::size_t count = particles.size();
  const float *px = particles.x.data(), *py = particles.y.data(), *pz = particles.z.data();
  float* const out = distance_m.data();
  for (const Capsule& c : capsules)
    for (std::size_t i = 0; i < count; ++i) {  // this is the inner loop, so that compilers vectorize it
      const float x = px[i] - c.start[0], y = py[i] - c.start[1], z = pz[i] - c.start[2];
      const float dot = x * c.along[0] + y * c.along[1] + z * c.along[2];
      const float t = std::min(1.0f, std::max(0.0f, dot * c.inverse_squared_length));
      const float u = x - t * c.along[0], v = y - t * c.along[1], w = z - t * c.along[2];
      out[i] = std::min(out[i], std::sqrt(u * u + v * v + w * w) - c.radius);
    }
}

}  // namespace bench
