// Based on: David Eberly. Distance from a Point to an Ellipse, an Ellipsoid, or a Hyperellipsoid. 2013.
// Differs: the root is sought in u = t + r_min^2 > 0, which keeps full relative precision next to the pole
// (needles, points near the medial disk); Newton on 1/|w(u)|, as for trust-region subproblems (Jorge J. More,
// Danny C. Sorensen. Computing a Trust Region Step. 1983.), from where a point of the surface has its root,
// and where that is slow a second bracket from the pole's own term, instead of bisection alone.
#include <algorithm>
#include <cmath>
#include <limits>

#include <bodice/geometry/ellipsoid.hpp>

namespace bodice::geometry {
namespace {

// Newton alone takes 2 to 4 steps near the surface; where the pole's term decides, the bracket squeezes in as
// many more. The bound is the number of bisections that exhausts any bracket that a factor of 2^60 spans.
constexpr int kMaxSteps = 64, kNewtonSteps = 4;
// Share of u that a last step may be long. With f = 1/|w| and g_j = 1 / (u + d_j) weighted by w_j^2, f'/f is
// the mean of g and f''/f minus three times its variance, so that -f''/f' <= 3 / u: a step of s leaves an
// error of at most 1.5 s^2 / u.
constexpr double kLastStep = 1e-8;
// A radius below this share of the scene's size is treated as this: its square must not underflow.
constexpr double kThinnest = 1e-140;

/// The problem in the ellipsoid's frame, first octant, scaled so that the largest number is 1:
/// w_j(u) = a_j / (u + d_j) with a = r o |y|, d_j = r_j^2 - r_min^2; the foot is r o w where |w(u)| = 1.
struct Secular {
  Vec3 a;
  Vec3 d;
  int pole;        // the axis of r_min
  double surface;  // r_min^2: the root of points on the surface

  /// 1 / (u + d); where a is zero the quotient means nothing, and is only kept finite.
  Vec3 inverse(double u) const { return (d.array() + u).max(std::numeric_limits<double>::min()).inverse(); }
  Vec3 w(double u) const { return a.cwiseProduct(inverse(u)); }
};

Secular make_secular(const Vec3& radii, const Vec3& abs_y) {
  Secular s{radii.cwiseProduct(abs_y), Vec3::Zero(), 0, 0.0};
  const double shortest = radii.minCoeff(&s.pole);
  for (int j = 0; j < 3; ++j) s.d[j] = (radii[j] - shortest) * (radii[j] + shortest);
  s.surface = shortest * shortest;
  return s;
}

/// Where the pole's term makes up what the other terms at u leave of |w|^2 = 1; infinite if they leave
/// nothing.
double pole_estimate(const Secular& s, const Vec3& w) {
  double rest = 1.0;
  for (int j = 0; j < 3; ++j)
    if (j != s.pole) rest -= w[j] * w[j];
  return rest > 0.0 ? s.a[s.pole] / std::sqrt(rest) : std::numeric_limits<double>::infinity();
}

/// The root of |w(u)| = 1 in u > 0, given |w(0+)| > 1. 1/|w| is concave and rises, so that a Newton step from
/// anywhere ends left of the root; the other terms fall with u, so the pole's estimate from one side bounds
/// the root on the other.
double solve(const Secular& s) {
  double high = s.a.sum();  // at least |a|, where |w| <= 1
  const double least = std::min(std::max(s.a[s.pole], (s.a - s.d).maxCoeff()), high);
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

/// The unit direction w of the foot, all components >= 0.
Vec3 foot_direction(const Vec3& radii, const Vec3& abs_y) {
  const Secular s = make_secular(radii, abs_y);
  const bool on_medial_plane = !(s.a[s.pole] > 0.0);
  Vec3 at_pole = on_medial_plane ? Vec3::Zero() : Vec3::Ones();
  if (on_medial_plane) {
    bool finite = true;
    for (int j = 0; j < 3; ++j) {
      if (!(s.a[j] > 0.0)) continue;
      finite = finite && s.a[j] <= s.d[j];
      if (finite) at_pole[j] = s.a[j] / s.d[j];
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
  Vec3 w = foot_direction(radii, scaled.cwiseAbs());
  for (int j = 0; j < 3; ++j) w[j] = y[j] < 0.0 ? -w[j] : w[j];
  const Vec3 foot = radii.cwiseProduct(w);
  const Vec3 slope = w.cwiseQuotient(radii);
  const Vec3 normal = (slope / slope.cwiseAbs().maxCoeff()).normalized();
  ClosestPoint result;
  result.point = ellipsoid.center + ellipsoid.axes * (size * foot);
  result.normal = ellipsoid.axes * normal;
  // First-order insensitive to an error of the foot along the surface.
  result.signed_distance = size * normal.dot(scaled - foot);
  return result;
}

}  // namespace bodice::geometry
