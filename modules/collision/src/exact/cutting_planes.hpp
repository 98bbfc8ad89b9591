// From a particle below its clearance to the closest place that keeps it, or that misses it by least.
#pragma once

#include "exact/halfspaces.hpp"
#include "exact/near_field.hpp"

namespace bodice::collision {

struct PushResult {
  geometry::Vec3 position;
  ReliefSample sample;  ///< there
  Halfspaces contact;   ///< the surfaces that hold it
  int rounds = 0;
  bool clear = false;     ///< sample.distance_m >= the clearance
  bool set_back = false;  ///< a place between planes that are set back: if it is clear, by chance
};

/// `start` is near.at(p). `overshoot_m` beyond the clearance is aimed at; no place farther than `longest_m`
/// is taken. At most kPlaneRounds evaluations. A place that is not clear is the best that was seen: midway
/// where two surfaces face each other, or p itself.
PushResult push_by_planes(NearField& near, const geometry::Vec3& p, const ReliefSample& start,
                          double clearance_m, double overshoot_m, double longest_m);

}  // namespace bodice::collision
