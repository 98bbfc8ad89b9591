// From the one number a user gives to the number of ellipsoids.
#pragma once

#include <bodice/fitting/fit.hpp>

namespace bodice::fitting {

/// Ellipsoids when nothing is asked for: the largest count of the paper's Table 2.
inline constexpr int kDefaultEllipsoids = 89;
/// A target error may ask for up to this many.
inline constexpr int kMostEllipsoids = 400;

/// Collision time a frame of 10,000 particles, from the count: measured constants of the collision layer on
/// one core (RELIEF.md's machine), so a dial and not a promise. Microseconds.
double predicted_frame_us(proxy::Tier tier, int ellipsoids);

/// The largest count whose predicted time is within the budget, at least 1.
int count_within_budget(proxy::Tier tier, double budget_us);

/// Mean gap to expect at a count, metres, for a body of this stature: gap ~ count^-0.5, anchored at 89.
double predicted_gap_m(proxy::Tier tier, int ellipsoids, double stature_m);

/// The count to start from for a target error, 1..kMostEllipsoids.
int count_for_error(proxy::Tier tier, double target_error_m, double stature_m);

}  // namespace bodice::fitting
