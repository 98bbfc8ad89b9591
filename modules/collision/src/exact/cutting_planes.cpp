// Based on: J. E. Kelley. The Cutting-Plane Method for Solving Convex Programs. 1960.
// Every place that is found below the clearance adds the half-space beyond its tangent plane; the next place
// is the nearest in all of them. Plain ellipsoids are convex, so that a point in all half-spaces is outside
// of all those ellipsoids, and a crease is met once and does not cycle.
// Differs: with relief or fillets the newest plane of an ellipsoid replaces its older ones, which is Newton's
// method along one surface. Planes that face each other are set back until they meet.
#include "exact/cutting_planes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/tolerances.hpp"

namespace bodice::collision {

using geometry::Vec3;

namespace {

/// The planes in force and whose they are.
class Planes {
 public:
  Planes(bool bent, double target_m) : bent_(bent), target_m_(target_m) {}

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

  /// Where the blend of surfaces that face each other is flat, each of them has its say.
  void put(const Vec3& x, const ReliefSample& sample, std::span<const NearField::Share> shares) {
    if (shares.size() < 2 || sample.gradient.norm() >= kFacing) return put(x, sample);
    for (const NearField::Share& share : shares)
      if (share.sample.distance_m < target_m_) put(x, share.sample);
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

  /// The place of this owner's older plane, a free one, or that of the plane which x is farthest beyond.
  int slot(std::uint32_t owner, const Vec3& x) const {
    for (int i = 0; bent_ && i < planes_.size(); ++i)
      if (owner_[i] == owner) return i;
    if (!planes_.full()) return planes_.size();
    int idle = 0;
    for (int i = 1; i < planes_.size(); ++i)
      if (planes_[i].gap_m(x) < planes_[idle].gap_m(x)) idle = i;
    return idle;
  }

  bool bent_;
  double target_m_;
  Halfspaces planes_;
  std::uint32_t owner_[Halfspaces::kCapacity] = {};
};

}  // namespace

Settled settle(NearField& near, const Vec3& p, const ReliefSample& start, double clearance_m,
               double overshoot_m, double longest_m) {
  const double target_m = clearance_m + overshoot_m;
  Planes planes(near.bent(), target_m);
  Settled best{p, start, {}, 0, start.distance_m >= clearance_m};
  // Most pushes are about as long as the depth; a longer one costs another search.
  near.expect(p, std::min(longest_m, kUsualPush * (target_m - start.distance_m)));
  ReliefSample here = near.bent() ? near.at(p) : start;
  Vec3 x = p;
  double last_set_back_m = -std::numeric_limits<double>::infinity();
  while (best.rounds < kSettleRounds && !best.clear) {
    ++best.rounds;
    planes.put(x, here, near.shares());
    // The closest point to p diverges where a surface bends within its depth; a step from x does not.
    const Vec3 base = near.bent() && best.rounds > kNearestRounds ? x : p;
    const double left_m = std::max(0.0, longest_m - (base - p).norm());
    const auto next = planes.halfspaces().least_violating(base, left_m, 0.1 * overshoot_m);
    x = next.x;
    here = near.at(x);
    const bool better = here.distance_m > best.at.distance_m;
    if (better) best.place = x, best.at = here, best.set_back = next.short_by_m > 0.0;
    best.clear = here.distance_m >= clearance_m;
    if (!(next.short_by_m > 0.0)) continue;
    // As good as planned, or no better than the one before, because it may not be farther.
    const double enough_m = kMidway * next.short_by_m, planned_m = target_m - next.short_by_m;
    if (std::abs(here.distance_m - planned_m) < enough_m) break;
    if (std::abs(here.distance_m - last_set_back_m) < enough_m) break;
    last_set_back_m = here.distance_m;
  }
  // Between two surfaces a particle that is as good as midway stays, so that it does not creep.
  const double missing_m = clearance_m - start.distance_m;
  if (!best.clear && best.at.distance_m - start.distance_m < kMidway * missing_m)
    best.place = p, best.at = start;
  best.contact = planes.touching(best.place, 2.0 * overshoot_m);
  if (best.contact.size() == 0) best.contact.add({best.at.gradient.stableNormalized(), 0.0});
  return best;
}

}  // namespace bodice::collision
