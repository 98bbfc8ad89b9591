// Based on: J. E. Kelley. The Cutting-Plane Method for Solving Convex Programs. 1960.
// Every position that is found below the clearance adds the half-space beyond its tangent plane; the next
// position is the closest point of their intersection. Plain ellipsoids are convex: a point in all
// half-spaces is outside of all those ellipsoids, so that the iteration does not cycle in a crease.
// Differs: with relief or fillets the newest plane of an ellipsoid replaces its older one, which is Newton's
// method along one surface. Planes that face each other are set back until they meet.
#include "exact/cutting_planes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/tolerances.hpp"

namespace bodice::inline v0_1::collision {

using geometry::Vec3;

namespace {

/// The cutting planes in force, each with the ellipsoid that it belongs to.
class Planes {
 public:
  Planes(bool nonconvex, double target_m) : nonconvex_(nonconvex), target_m_(target_m) {}

  const Halfspaces& halfspaces() const { return planes_; }

  void put(const Vec3& x, const ReliefSample& sample) {
    const double slope = std::max(sample.gradient.norm(), kLeastSlope);
    const Vec3 normal = sample.gradient.stableNormalized();
    const Halfspace plane{normal, normal.dot(x) + (target_m_ - sample.distance_m) / slope};
    const int at = slot(sample.owner, x);
    if (at == planes_.size())
      planes_.add(plane);
    else
      planes_.replace(at, plane);
    owner_[at] = sample.owner;
  }

  /// Adds the plane of the blended surface. Where surfaces face each other their blend is flat, and the plane
  /// of each surface is added instead.
  void put(const Vec3& x, const ReliefSample& sample, std::span<const NearField::Term> terms) {
    if (terms.size() < 2 || sample.gradient.norm() >= kFacing) return put(x, sample);
    for (const NearField::Term& term : terms)
      if (term.sample.distance_m < target_m_) put(x, term.sample);
  }

  /// The planes that x lies on.
  Halfspaces touching(const Vec3& x, double within_m) const {
    Halfspaces result;
    for (int i = 0; i < planes_.size(); ++i)
      if (planes_[i].gap_m(x) > -within_m) result.add(planes_[i]);
    return result;
  }

 private:
  static constexpr double kLeastSlope = 0.5, kFacing = 0.5;

  /// Index for a new plane: that of this owner's older plane, a free one, or that of the plane which x is
  /// farthest beyond.
  int slot(std::uint32_t owner, const Vec3& x) const {
    for (int i = 0; nonconvex_ && i < planes_.size(); ++i)
      if (owner_[i] == owner) return i;
    if (!planes_.full()) return planes_.size();
    int idle = 0;
    for (int i = 1; i < planes_.size(); ++i)
      if (planes_[i].gap_m(x) < planes_[idle].gap_m(x)) idle = i;
    return idle;
  }

  bool nonconvex_;
  double target_m_;
  Halfspaces planes_;
  std::uint32_t owner_[Halfspaces::kCapacity] = {};
};

}  // namespace

PushResult push_by_planes(NearField& near, const Vec3& p, const ReliefSample& start, double clearance_m,
                          double overshoot_m, double longest_m) {
  const double target_m = clearance_m + overshoot_m;
  Planes planes(near.nonconvex(), target_m);
  PushResult best{p, start, {}, 0, start.distance_m >= clearance_m};
  // Most pushes are about as long as the depth. A longer one costs another search for candidates.
  near.prepare(p, std::min(longest_m, kUsualPush * (target_m - start.distance_m)));
  ReliefSample here = near.nonconvex() ? near.at(p) : start;
  Vec3 x = p;
  double last_set_back_m = -std::numeric_limits<double>::infinity();
  while (best.rounds < kPlaneRounds && !best.clear) {
    ++best.rounds;
    planes.put(x, here, near.terms());
    // The closest point to p diverges where a surface curves within its depth; a step from x does not.
    const Vec3 base = near.nonconvex() && best.rounds > kNearestRounds ? x : p;
    const double left_m = std::max(0.0, longest_m - (base - p).norm());
    const auto next = planes.halfspaces().least_violating(base, left_m, 0.1 * overshoot_m);
    x = next.x;
    here = near.at(x);
    const bool better = here.distance_m > best.sample.distance_m;
    if (better) best.position = x, best.sample = here, best.set_back = next.set_back_m > 0.0;
    best.clear = here.distance_m >= clearance_m;
    if (!(next.set_back_m > 0.0)) continue;
    // The iteration ends when the distance is as planned, or when it no longer improves because the push may
    // not become longer.
    const double enough_m = kMidway * next.set_back_m, planned_m = target_m - next.set_back_m;
    if (std::abs(here.distance_m - planned_m) < enough_m) break;
    if (std::abs(here.distance_m - last_set_back_m) < enough_m) break;
    last_set_back_m = here.distance_m;
  }
  // Between two surfaces a particle that is almost midway stays where it is, so that it does not creep.
  const double missing_m = clearance_m - start.distance_m;
  if (!best.clear && best.sample.distance_m - start.distance_m < kMidway * missing_m)
    best.position = p, best.sample = start;
  best.contact = planes.touching(best.position, 2.0 * overshoot_m);
  if (best.contact.size() == 0) best.contact.add({best.sample.gradient.stableNormalized(), 0.0});
  return best;
}

}  // namespace bodice::collision
