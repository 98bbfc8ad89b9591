// The closest point of an ellipsoid's surface in double precision. Equation numbers are those of the
// derivation in modules/geometry/README.md.
// Based on: David Eberly. Distance from a Point to an Ellipse, an Ellipsoid, or a Hyperellipsoid. 2013; Jorge
// J. More, Danny C. Sorensen. Computing a Trust Region Step. 1983, for eq. (6).
// Differs: the root is sought in u instead of t, which keeps full relative precision next to the pole
// (needles, points near the medial disk). Newton starts where a point of the surface has its root. Where it
// is slow, eq. (7) gives a second bracket, in place of bisection alone.
#include <algorithm>
#include <cmath>
#include <limits>

#include <bodice/geometry/ellipsoid.hpp>

namespace bodice::inline v0_1::geometry {
namespace {

// Newton alone takes 2 to 4 steps near the surface. Where the pole's term decides, the bracket takes as many
// more to close. The bound is the number of bisections that exhausts a bracket of ends up to 2^60 times
// apart.
constexpr int kMaxSteps = 64, kNewtonSteps = 4;
// The relative length of a step after which the search ends. With f = 1/|w|, the derivatives satisfy -f''/f'
// <= 3 / u, so that a step of s leaves an error of at most 1.5 s^2 / u. (With g_j = 1 / (u + gap_j), weighted
// by w_j^2: f'/f is the mean of g, and f''/f is minus three times its variance.)
constexpr double kLastStep = 1e-8;
// Radii below this fraction of the largest number are raised to it, since their squares would underflow.
constexpr double kThinnest = 1e-140;

/// Eq. (3) in the first octant of the ellipsoid's frame, with the largest number as the unit of length.
struct Secular {
  Vec3 a;          // r o |y|
  Vec3 gap;        // r_j^2 - r_min^2
  int pole;        // the axis of r_min
  double surface;  // r_min^2, which is the root for a point on the surface

  /// 1 / (u + gap) of each axis. Where a is zero the quotient has no meaning and is only kept finite.
  Vec3 inverse(double u) const { return (gap.array() + u).max(std::numeric_limits<double>::min()).inverse(); }
  Vec3 w(double u) const { return a.cwiseProduct(inverse(u)); }
};

Secular make_secular(const Vec3& radii, const Vec3& abs_y) {
  Secular s{radii.cwiseProduct(abs_y), Vec3::Zero(), 0, 0.0};
  const double shortest = radii.minCoeff(&s.pole);
  for (int j = 0; j < 3; ++j) s.gap[j] = (radii[j] - shortest) * (radii[j] + shortest);
  s.surface = shortest * shortest;
  return s;
}

/// The u of eq. (7), given w at some u; infinite if the other terms leave nothing to the pole's.
double pole_estimate(const Secular& s, const Vec3& w) {
  double rest = 1.0;
  for (int j = 0; j < 3; ++j)
    if (j != s.pole) rest -= w[j] * w[j];
  return rest > 0.0 ? s.a[s.pole] / std::sqrt(rest) : std::numeric_limits<double>::infinity();
}

/// The root u > 0 of eq. (4), given |w(0+)| > 1. Since 1/|w| is concave and rises, a Newton step from
/// anywhere ends left of the root. The other terms of |w|^2 fall with u, so that eq. (7) from one side bounds
/// the root on the other.
double solve(const Secular& s) {
  double high = s.a.sum();  // at least |a|, where |w| <= 1
  const double least = std::min(std::max(s.a[s.pole], (s.a - s.gap).maxCoeff()), high);
  double u = std::min(std::max(least, s.surface), high);
  for (int step = 0; step < kMaxSteps; ++step) {
    const Vec3 inverse = s.inverse(u), w = s.a.cwiseProduct(inverse), w2 = w.cwiseProduct(w);
    const double norm2 = w2.sum();
    double next = std::max(least, u + (std::sqrt(norm2) - 1.0) * norm2 / w2.dot(inverse));
    if (step >= kNewtonSteps) {
      high = std::min(high, std::max(u, pole_estimate(s, w)));
      const double from_pole = pole_estimate(s, s.w(high));
      next = std::min(std::max(next, std::isfinite(from_pole) ? from_pole : 0.0), high);
      if (high - next <= kLastStep * kLastStep * high) return next;
    }
    if (std::abs(next - u) <= kLastStep * u) return next;
    u = next;
  }
  return u;
}

/// The unit vector w of eq. (1); its components are at least 0.
Vec3 closest_direction(const Vec3& radii, const Vec3& abs_y) {
  const Secular s = make_secular(radii, abs_y);
  const bool on_medial_plane = !(s.a[s.pole] > 0.0);
  Vec3 at_pole = on_medial_plane ? Vec3::Zero() : Vec3::Ones();
  if (on_medial_plane) {
    bool finite = true;
    for (int j = 0; j < 3; ++j) {
      if (!(s.a[j] > 0.0)) continue;
      finite = finite && s.a[j] <= s.gap[j];
      if (finite) at_pole[j] = s.a[j] / s.gap[j];
    }
    const double rest = 1.0 - at_pole.squaredNorm();
    if (finite && rest >= 0.0) {
      at_pole[s.pole] = std::sqrt(rest);
      return at_pole;
    }
  }
  return s.w(solve(s)).normalized();
}

}  // namespace

ClosestPoint closest_point(const Ellipsoid& ellipsoid, const Vec3& point) {
  const Vec3 y = ellipsoid.axes.transpose() * (point - ellipsoid.center);
  const double size =
      std::max({ellipsoid.radii.maxCoeff(), y.cwiseAbs().maxCoeff(), std::numeric_limits<double>::min()});
  const double per_size = 1.0 / size;
  const Vec3 radii = (ellipsoid.radii * per_size).cwiseMax(kThinnest);
  const Vec3 scaled = y * per_size;
  Vec3 w = closest_direction(radii, scaled.cwiseAbs());
  for (int j = 0; j < 3; ++j) w[j] = y[j] < 0.0 ? -w[j] : w[j];
  const Vec3 closest = radii.cwiseProduct(w);
  const Vec3 slope = w.cwiseQuotient(radii);
  const Vec3 normal = (slope / slope.cwiseAbs().maxCoeff()).normalized();
  ClosestPoint result;
  result.point = ellipsoid.center + ellipsoid.axes * (size * closest);
  result.normal = ellipsoid.axes * normal;
  // Eq. (5). An error of the closest point along the surface changes it to second order only.
  result.signed_distance = size * normal.dot(scaled - closest);
  return result;
}

}  // namespace bodice::geometry
