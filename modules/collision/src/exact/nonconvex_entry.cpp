// Based on: John C. Hart. Sphere Tracing: A Geometric Method for the Antialiased Ray Tracing of Implicit
// Surfaces. 1996.
// Differs: a step is half the distance, since relief steepens it. A least step replaces convergence, since
// only a clear point on this side of the surface is needed.
#include <algorithm>
#include <cmath>

#include "exact/ray_exits.hpp"
#include "model/tolerances.hpp"

namespace bodice::inline v0_1::collision {

using geometry::Vec3;

namespace {

constexpr int kSteps = 128;
constexpr int kHalvings = 20;

/// Length of a step from x along which the distance certainly stays above the clearance.
double free_path_m(NearField& near, const UnionField& field, double bulge_m, const Vec3& x, double distance_m,
                   double clearance_m) {
  const double known_m = 0.5 * (distance_m - clearance_m);
  if (near.terms().size() > 0) return known_m;
  // Far off, the plain ellipsoids' distance is 1-Lipschitz and the surface lies at most bulge_m beyond them.
  const Owner owner = field.owner(x, std::numeric_limits<double>::infinity());
  return std::max(known_m, owner.at.signed_distance - bulge_m - clearance_m);
}

}  // namespace

std::optional<Entry> first_nonconvex_entry(NearField& near, const UnionField& field, double bulge_m,
                                           const Vec3& safe, const Vec3& p, double clearance_m) {
  const double length = (p - safe).norm();
  if (!(length > 0.0)) return std::nullopt;
  const Vec3 direction = (p - safe) / length;
  const double least_step = kPathStep * field.size_m();
  ReliefSample here = near.at(safe);
  if (here.distance_m < clearance_m) return std::nullopt;
  double t = 0.0;
  for (int step = 0; step < kSteps && t < length; ++step) {
    const Vec3 x = safe + t * direction;
    const double free_m = free_path_m(near, field, bulge_m, x, here.distance_m, clearance_m);
    double next = std::min(length, t + std::max(free_m, least_step));
    const ReliefSample there = near.at(safe + next * direction);
    if (there.distance_m >= clearance_m) {
      t = next;
      here = there;
      continue;
    }
    Entry entry{x, there.gradient.stableNormalized(), there.owner};
    for (int i = 0; i < kHalvings && next - t > kCertificate * field.size_m(); ++i) {
      const double middle = 0.5 * (t + next);
      const ReliefSample at = near.at(safe + middle * direction);
      (at.distance_m >= clearance_m ? t : next) = middle;
      if (at.distance_m < clearance_m) entry.normal = at.gradient.stableNormalized();
    }
    entry.point = safe + std::max(0.0, t - kBesideJump * field.size_m()) * direction;
    return entry;
  }
  if (t >= length) return std::nullopt;
  // A path that grazes a surface for all steps ends where it is clear.
  return Entry{safe + t * direction, here.gradient.stableNormalized(), here.owner};
}

}  // namespace bodice::collision
