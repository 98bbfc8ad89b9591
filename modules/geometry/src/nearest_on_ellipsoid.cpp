// Based on: David Eberly. Distance from a Point to an Ellipse, an Ellipsoid, or a Hyperellipsoid. 2013.
// Differs: the root is sought in u = t + r_min^2 > 0, which keeps full relative precision next to the pole
// (needles, points near the medial disk); Newton on 1/|w(u)|, as for trust-region subproblems (Jorge J. More,
// Danny C. Sorensen. Computing a Trust Region Step. 1983.), and a second bracket from the pole's own term,
// instead of bisection alone.
#include <algorithm>
#include <cmath>
#include <limits>

#include <bodice/geometry/ellipsoid.hpp>

namespace bodice::geometry {
namespace {

// Newton alone takes 3 to 8 steps; where the pole's term decides, the bracket squeezes in as many. The bound
// is the number of bisections that exhausts any bracket that a factor of 2^60 spans.
constexpr int kMaxSteps = 64;
constexpr double kRootTolerance = 4.0 * std::numeric_limits<double>::epsilon();
// A radius below this share of the scene's size is treated as this: its square must not underflow.
constexpr double kThinnest = 1e-140;

/// The problem in the ellipsoid's frame, first octant, scaled so that the largest number is 1:
/// w_j(u) = a_j / (u + d_j) with a = r o |y|, d_j = r_j^2 - r_min^2; the foot is r o w where |w(u)| = 1.
struct Secular {
  Vec3 a;
  Vec3 d;
  int pole;  // the axis of r_min

  Vec3 w(double u) const {
    Vec3 result = Vec3::Zero();
    for (int j = 0; j < 3; ++j)
      if (a[j] > 0.0) result[j] = a[j] / (u + d[j]);
    return result;
  }
};

Secular make_secular(const Vec3& radii, const Vec3& abs_y) {
  Secular s{radii.cwiseProduct(abs_y), Vec3::Zero(), 0};
  const double shortest = radii.minCoeff(&s.pole);
  for (int j = 0; j < 3; ++j) s.d[j] = (radii[j] - shortest) * (radii[j] + shortest);
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

/// The root of |w(u)| = 1 in u > 0, given |w(0+)| > 1. 1/|w| is concave and rises, so a Newton step from the
/// left stays left of the root; the other terms fall with u, so the pole's estimate from one side bounds the
/// root on the other.
double solve(const Secular& s) {
  double low = std::max(s.a[s.pole], (s.a - s.d).maxCoeff());
  double high = s.a.stableNorm();
  low = std::min(low, high);
  for (int step = 0; step < kMaxSteps; ++step) {
    const Vec3 w = s.w(low);
    const double norm2 = w.squaredNorm();
    const double norm = std::sqrt(norm2);
    if (!(norm > 1.0)) return low;
    double slope = 0.0;
    for (int j = 0; j < 3; ++j)
      if (w[j] > 0.0) slope += w[j] * w[j] / (low + s.d[j]);
    const double newton = low + (norm - 1.0) * norm2 / slope;
    high = std::min(high, std::max(low, pole_estimate(s, w)));
    const double from_pole = pole_estimate(s, s.w(high));
    const double next = std::min(std::max(newton, std::isfinite(from_pole) ? from_pole : 0.0), high);
    if (next - low <= kRootTolerance * next || high - next <= kRootTolerance * high) return next;
    low = next;
  }
  return low;
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
  return s.w(solve(s)).stableNormalized();
}

}  // namespace

NearestPoint nearest_point(const Ellipsoid& ellipsoid, const Vec3& point) {
  const Vec3 y = ellipsoid.axes.transpose() * (point - ellipsoid.center);
  const double size = std::max(ellipsoid.radii.maxCoeff(), y.cwiseAbs().maxCoeff());
  const Vec3 radii = (ellipsoid.radii / size).cwiseMax(kThinnest);
  const Vec3 scaled = y / size;
  Vec3 w = foot_direction(radii, scaled.cwiseAbs());
  for (int j = 0; j < 3; ++j)
    if (y[j] < 0.0) w[j] = -w[j];
  const Vec3 foot = radii.cwiseProduct(w);
  const Vec3 normal = w.cwiseQuotient(radii / radii.minCoeff()).stableNormalized();
  NearestPoint result;
  result.point = ellipsoid.center + ellipsoid.axes * (size * foot);
  result.normal = ellipsoid.axes * normal;
  // First-order insensitive to an error of the foot along the surface.
  result.signed_distance = size * normal.dot(scaled - foot);
  return result;
}

}  // namespace bodice::geometry
