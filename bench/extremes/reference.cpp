#include "reference.hpp"

#include <algorithm>
#include <cmath>

namespace extremes_bench {
namespace {

using Real = long double;
using Real3 = Eigen::Matrix<Real, 3, 1>;

/// Eberly's function, the sum of (r y / (s + r^2 - r_min^2))^2 - 1, which falls as s = t + r_min^2 grows. It
/// is written in s instead of t, so that nothing cancels next to the medial plane.
Real excess(const Real3& r, const Real3& y, Real r_min, Real s) {
  Real sum = -1.0L;
  for (int k = 0; k < 3; ++k) {
    const Real w = r[k] * y[k] / (s + (r[k] - r_min) * (r[k] + r_min));
    sum += w * w;
  }
  return sum;
}

}  // namespace

double signed_distance(const bodice::geometry::Ellipsoid& e, const bodice::geometry::Vec3& point) {
  const Real size = e.radii.maxCoeff();
  const Real3 r = e.radii.cast<Real>() / size;
  const Real3 y = e.axes.cast<Real>().transpose() * (point.cast<Real>() - e.center.cast<Real>()) / size;
  const Real r_min = r.minCoeff();
  Real low = 0.0L, high = r.cwiseProduct(y).norm() + r_min * r_min;
  constexpr int kSteps = 300;  // halves any interval below the last bit
  for (int step = 0; step < kSteps; ++step) {
    const Real middle = 0.5L * (low + high);
    if (middle <= low || middle >= high) break;
    (excess(r, y, r_min, middle) > 0.0L ? low : high) = middle;
  }
  const Real s = 0.5L * (low + high), t = s - r_min * r_min;
  Real squared = 0.0L;
  for (int k = 0; k < 3; ++k) {
    const Real d = y[k] / (s + (r[k] - r_min) * (r[k] + r_min));
    squared += d * d;
  }
  return static_cast<double>(t * std::sqrt(squared) * size);
}

}  // namespace extremes_bench
