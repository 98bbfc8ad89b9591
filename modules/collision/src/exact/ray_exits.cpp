#include "exact/ray_exits.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/tolerances.hpp"

namespace bodice::inline v0_1::collision {

using geometry::ClosestPoint;
using geometry::Ellipsoid;
using geometry::Vec3;

namespace {

constexpr int kEntrySteps = 48;  // Newton from outside takes 5 to 8 steps, more where the path grazes

/// The point in the frame in which the ellipsoid is the unit ball.
Vec3 to_unit_ball(const Ellipsoid& e, const Vec3& p) {
  return (e.axes.transpose() * (p - e.center)).cwiseQuotient(e.radii);
}

struct Interval {
  double begin, end;
};

/// The interval of t in which a + t b lies in the unit ball; nothing if it never does.
std::optional<Interval> inside_ball(const Vec3& a, const Vec3& b) {
  const double bb = b.squaredNorm();
  if (!(bb > 0.0)) return std::nullopt;
  const double middle = -a.dot(b) / bb;
  const double discriminant = 1.0 - (a + middle * b).squaredNorm();
  if (!(discriminant > 0.0)) return std::nullopt;
  const double half = std::sqrt(discriminant / bb);
  return Interval{middle - half, middle + half};
}

constexpr int kExitSteps = 4;  // Newton from outside: each step at least halves the rest, most square it

/// Ray parameter at which the ray leaves an enlarged ellipsoid: scaled so that it contains every point nearer
/// than the clearance.
std::optional<double> exit_of_enlarged(const Ellipsoid& e, const Vec3& x, const Vec3& direction,
                                       double clearance_m) {
  const double share = 1.0 / (1.0 + std::max(0.0, clearance_m) / e.radii.minCoeff());
  const Vec3 b = (e.axes.transpose() * direction).cwiseQuotient(e.radii);
  const auto inside = inside_ball(share * to_unit_ball(e, x), share * b);
  if (!inside || !(inside->end > 0.0)) return std::nullopt;
  return inside->end;
}

/// Ray parameter at which a particle at x, inside the owner or too near it, has left the owner and its
/// clearance.
double exit_parameter(const UnionField& field, const Owner& owner, const Vec3& x, const Vec3& direction,
                      double clearance_m, double nudge_m) {
  const double gap = clearance_m - owner.at.signed_distance;
  const double slope = owner.at.normal.dot(direction);
  const Ellipsoid& e = field.shape(owner.ellipsoid);
  // By convexity the tangent's root lies at or beyond the root of the distance, hence outside.
  double t = slope > kFlatSlope ? gap / slope : std::numeric_limits<double>::infinity();
  t = std::min(t, exit_of_enlarged(e, x, direction, clearance_m).value_or(t));
  if (!std::isfinite(t)) return gap + nudge_m;
  // From outside, again by convexity, a tangent's root lies between the root of the distance and the current
  // point.
  for (int step = 0; step < kExitSteps; ++step) {
    const ClosestPoint at = geometry::closest_point(e, x + t * direction);
    const double beyond = at.signed_distance - clearance_m, rise = at.normal.dot(direction);
    if (!(beyond > nudge_m) || !(rise > kFlatSlope)) break;
    t -= beyond / rise;
  }
  return t + nudge_m;
}

}  // namespace

std::optional<Vec3> exit_along_ray(const UnionField& field, const Vec3& p, const Vec3& direction,
                                   double clearance_m, double longest_m) {
  const double nudge_m = kCertificate * (field.size_m() + p.cwiseAbs().maxCoeff());
  Vec3 x = p;
  // Each ellipsoid costs one step to its far side and a few for the clearance.
  const std::size_t limit = 8 * field.size() + 8;
  for (std::size_t step = 0; step < limit && !((x - p).norm() > longest_m); ++step) {
    const Owner owner = field.owner(x, clearance_m);
    if (owner.ellipsoid == kNoEllipsoid) return x;
    x += exit_parameter(field, owner, x, direction, clearance_m, nudge_m) * direction;
  }
  return std::nullopt;
}

std::optional<Entry> first_entry(const UnionField& field, const Vec3& safe, const Vec3& p,
                                 double clearance_m) {
  const Vec3 path = p - safe;
  const double length = path.norm();
  if (!(length > 0.0) || field.owner(safe, clearance_m).ellipsoid != kNoEllipsoid) return std::nullopt;
  const Vec3 direction = path / length;
  const double arrived = kCertificate * (field.size_m() + length);
  Entry entry{safe, Vec3::Zero(), kNoEllipsoid};
  double t = 0.0;
  for (int step = 0; step < kEntrySteps; ++step) {
    double advance = length - t;
    entry.ellipsoid = kNoEllipsoid;
    const auto visit = [&](std::size_t k, const UnionField::Plane&) {
      const ClosestPoint at = geometry::closest_point(field.shape(k), entry.point);
      const double slope = at.normal.dot(direction);
      // By convexity the distance stays above the clearance before the tangent's root.
      if (slope >= 0.0 || at.signed_distance - clearance_m >= -slope * advance) return;
      advance = std::max(0.0, (at.signed_distance - clearance_m) / -slope);
      entry.normal = at.normal;
      entry.ellipsoid = static_cast<std::uint32_t>(k);
    };
    field.visit_near(
        entry.point, [&] { return advance + clearance_m; }, visit);
    if (entry.ellipsoid == kNoEllipsoid) return std::nullopt;
    if (advance <= arrived) return entry;
    t += advance;
    entry.point = safe + t * direction;
  }
  return entry;
}

std::uint32_t passed_through(const UnionField& field, const ParticleState& particle, const Vec3& to) {
  for (std::size_t k = 0; k < field.size(); ++k) {
    const Vec3 from = particle.path_start(k);
    const geometry::Box segment{from.cwiseMin(to), from.cwiseMax(to)};
    const geometry::Box& box = field.box(k);
    if ((box.low.array() > segment.high.array()).any() || (box.high.array() < segment.low.array()).any())
      continue;
    const Ellipsoid& e = field.shape(k);
    const Vec3 a = to_unit_ball(e, from);
    const Vec3 b = to_unit_ball(e, to) - a;
    const auto inside = inside_ball(a, b);
    // Both ends are known to lie outside; the slack admits paths that begin or end in contact.
    if (!inside || inside->begin < -kEndSlack || inside->end > 1.0 + kEndSlack) continue;
    const Vec3 in = (a + inside->begin * b).cwiseQuotient(e.radii).normalized();
    const Vec3 out = (a + inside->end * b).cwiseQuotient(e.radii).normalized();
    if (in.dot(out) < kSlidingCosine) return static_cast<std::uint32_t>(k);
  }
  return kNoEllipsoid;
}

}  // namespace bodice::collision
