// Differs from the paper's section 4: the nearest point of the union instead of the central ray of one
// ellipsoid. Every violated ellipsoid adds the half-space beyond its tangent plane; by convexity a point in
// all of them is outside all of those ellipsoids, so that a crease is met once and does not cycle.
#include <cmath>

#include "exits.hpp"
#include "response.hpp"
#include "tolerances.hpp"

namespace bodice::collision {

using geometry::Vec3;

namespace {

constexpr int kMaxRounds = 6;  // a body's creases join two or three ellipsoids

/// The tangent half-space at the foot, raised by the clearance and the overshoot that rounding needs.
Halfspace beyond(const Owner& owner, double clearance_m) {
  const Vec3& n = owner.at.normal;
  return {n, n.dot(owner.at.point) + clearance_m};
}

/// Iterates to a point that is clear of every ellipsoid; false if the rounds run out or the way is long.
bool iterate(const UnionField& field, const Vec3& p, const Owner& deepest, double clearance_m, double slack_m,
             Halfspaces& contact, Vec3& x, int& iterations) {
  const double longest = kLongestPush * (clearance_m - deepest.at.signed_distance) + slack_m;
  Owner worst = deepest;
  for (iterations = 1; iterations <= kMaxRounds && !contact.full(); ++iterations) {
    contact.add(beyond(worst, clearance_m + slack_m));
    x = contact.project(p, 0.1 * slack_m);
    if ((x - p).norm() > longest) return false;
    worst = field.owner(x, clearance_m);
    if (worst.ellipsoid == kNoEllipsoid) return true;
  }
  return false;
}

/// Takes the inward part out of the velocity and slows the rest by Coulomb friction, restitution 0.
void correct_velocity(const Halfspaces& contact, double friction, Vec3& velocity) {
  const Vec3 along = contact.cone().project(velocity, 0.0);
  const double impulse = (along - velocity).norm();
  const double speed = along.norm();
  velocity =
      speed > friction * impulse ? Vec3(along * (1.0 - friction * impulse / speed)) : Vec3(Vec3::Zero());
}

Halfspaces single(const Vec3& normal) {
  Halfspaces result;
  result.add({normal, 0.0});
  return result;
}

/// Back to where the path from the safe position met the union, if leaving at `x` would be on another side.
bool back_to_entry(const UnionField& field, const ParticleState& particle, double clearance_m,
                   const Vec3& normal, Vec3& x, Halfspaces& contact) {
  if (!particle.has_safe) return false;
  const auto entry = first_entry(field, particle.safe, particle.position, clearance_m);
  if (!entry || entry->normal.dot(normal) >= kSlidingCosine) return false;
  x = entry->point;
  contact = single(entry->normal);
  return true;
}

}  // namespace

void move(const Vec3& p, const Vec3& x, const Halfspaces& contact, const ResolveOptions& options,
          ParticleReport& report, ParticleState& particle) {
  const double push = (x - p).norm();
  particle.position = x;
  if (!report.wrong_side && push > double{options.max_push_m}) {
    particle.position = p + (x - p) * (double{options.max_push_m} / push);
    report.outcome = Outcome::kPending;
  }
  if (!particle.has_velocity) return;
  Vec3 relative = particle.velocity - particle.surface_velocity;
  correct_velocity(contact, double{options.friction}, relative);
  particle.velocity = relative + particle.surface_velocity;
}

ParticleReport resolve_nearest(const UnionField& field, double clearance_m, const ResolveOptions& options,
                               ParticleState& particle) {
  ParticleReport report;
  const Vec3 p = particle.position;
  const double slack_m = kCertificate * (field.size_m() + p.cwiseAbs().maxCoeff());
  const Owner deepest = field.owner(p, clearance_m);
  Halfspaces contact;
  Vec3 x = p;
  if (deepest.ellipsoid == kNoEllipsoid) {
    if (!particle.has_safe || !passes_through(field, particle.safe, p)) return report;
    const auto entry = first_entry(field, particle.safe, p, clearance_m);
    if (!entry) return report;
    x = entry->point;
    contact = single(entry->normal);
    report.ellipsoid = entry->ellipsoid;
    report.wrong_side = true;
    report.outcome = Outcome::kResolved;
  } else {
    report.ellipsoid = deepest.ellipsoid;
    report.depth_m = clearance_m - deepest.at.signed_distance;
    report.outcome = Outcome::kResolved;
    if (!iterate(field, p, deepest, clearance_m, slack_m, contact, x, report.iterations)) {
      report.fallback = true;
      contact = single(deepest.at.normal);
      const auto exit = exit_along_ray(field, p, deepest.at.normal, clearance_m);
      if (exit) x = *exit + slack_m * deepest.at.normal;
      if (!exit) report.outcome = Outcome::kUnresolved;
    }
    report.wrong_side = back_to_entry(field, particle, clearance_m, contact[0].normal, x, contact);
    if (report.wrong_side) report.outcome = Outcome::kResolved;
  }
  move(p, x, contact, options, report, particle);
  return report;
}

}  // namespace bodice::collision
