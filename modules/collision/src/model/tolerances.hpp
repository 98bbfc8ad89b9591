// Every tolerance of the module, each with its unit and its reason. "Union's size" is the largest coordinate
// of the union in the local frame, about half the stature.
#pragma once

namespace bodice::inline v0_1::collision {

/// Certificate: depth below its clearance at which a resolved particle still counts as clear, as a fraction
/// of the coordinates of union and particle. Pushes overshoot by as much. Positions are stored as floats,
/// which round them by 6e-8 of their coordinates.
inline constexpr double kCertificate = 2e-7;

/// Certificate with relief, as a fraction of its blend radius, which is proportional to the stature: 5
/// micrometers of 3 mm. That is a tenth of what relief promises and a hundred times what rounding does
/// through tables of usual slope.
inline constexpr double kReliefCertificate = 5e-3 / 3.0;

/// Relative widening of float bounds, as a fraction of the union's size: a dozen roundings of 6e-8, so that
/// the broad phase never drops what exact arithmetic would keep.
inline constexpr double kFloatRounding = 1e-6;

/// Relative growth of the ellipsoids that lower bounds are computed from (Baked::bounds). It covers the error
/// of the processor's estimates of roots, up to 3.7e-4, so that no bound exceeds its distance.
inline constexpr float kBoundGrowth = 5.5e-4f;

/// Error of the float solver's closest point and distance, as a fraction of the longest radius (or of the
/// distance from the center, if larger): nearly twice the worst of 120 million random cases (`bench/response
/// nearest`).
inline constexpr double kClosestPointError = 1e-6;

/// Cosine below which a ray runs along a surface rather than out of it.
inline constexpr double kFlatSlope = 1e-3;

/// Cosine of the angle between the surface normals at the two ends of a path. A particle that slides over a
/// limb turns by less than 60 degrees a call; one that passes through it turns by more.
inline constexpr double kSlidingCosine = 0.5;

/// Fraction of a path by which its ends may lie inside an ellipsoid and still count as touching it.
inline constexpr double kEndSlack = 1e-2;

/// Longest push, in multiples of the depth. A longer one comes from surfaces that nearly face each other,
/// where the exit along the normal is shorter.
inline constexpr double kLongestPush = 4.0;

/// The same out of plain ellipsoids for pushes that are longer than kShortPush: a right-angled corner of
/// three takes 1.7. Deep between many of them, planes that were added on the path lead as much as three times
/// too far, and the exact side shortens such a push.
inline constexpr double kLongestPlainPush = 2.0;

/// A push that is not worth shortening, as a fraction of the union's size: 90 mm on a person.
inline constexpr double kShortPush = 0.1;

/// Usual length of a push out of a crease, in multiples of the depth.
inline constexpr double kUsualPush = 1.5;

/// Rounds of cutting planes a particle. A body's creases join two or three ellipsoids, and on a nonconvex
/// surface Newton takes two or three steps.
inline constexpr int kPlaneRounds = 10;

/// The first of these rounds, which search for the closest point to the start even on a nonconvex surface;
/// later rounds step from the last position.
inline constexpr int kNearestRounds = 3;

/// Error of a position midway between two surfaces, as a fraction of the missing clearance.
inline constexpr double kMidway = 0.05;

/// Overshoot of pushes, as a fraction of the blend radius, so that Newton's steps over a nonconvex surface
/// arrive from below: 6 micrometers of 3 mm.
inline constexpr double kReliefOvershoot = 2e-3;

/// Additional overshoot of the first push out of relief, as a fraction of its length. The error of a Newton
/// step grows with its length, and a step that falls short costs another query.
inline constexpr double kStepOvershoot = 1e-2;

/// Overshoot of a push onto a fillet, in multiples of kCertificate. Fillets are smooth; with more, particles
/// at rest in one would chatter.
inline constexpr double kFilletOvershoot = 20.0;

/// A path longer than this fraction of the shortest radius nearby may have changed sides.
inline constexpr double kLongPath = 0.3;

/// Least step along a path through relief, as a fraction of the union's size: a quarter of a millimeter of a
/// body.
inline constexpr double kPathStep = 3e-4;

/// Distance by which a point found by bisection is moved to the clear side, as a fraction of the union's
/// size: one micrometer of a body. Relief jumps where an ellipsoid's closest point changes sides, and
/// rounding to float must not cross the jump.
inline constexpr double kBesideJump = 1e-6;

/// Depth, as a fraction of the union's size, up to which a position without room around it counts as a fold
/// of the skin, where limbs overlap: a centimeter of a body.
inline constexpr double kFoldDepth = 1e-2;

/// An exit is replaced by a shorter one of unknown contacts only if that is less than this fraction of it.
inline constexpr double kWorthShortening = 0.9;

/// A ray exit replaces another exit only if it is shorter than this fraction of it.
inline constexpr double kMuchShorter = 0.75;

/// Bisections of the segment between a particle and a clear point: from a meter to a micrometer.
inline constexpr int kExitHalvings = 20;

/// Coordinates beyond this, meters, are not sorted with the rest and go to the exact side. Their squares must
/// stay in float range even in units of the smallest radius that a proxy may have.
inline constexpr float kFarthest_m = 1e9f;

/// Distance of particles half a block apart, relative to that of any two of a task, above which sorting the
/// task pays. It is 1 in random order and a quarter along a space-filling curve.
inline constexpr double kScattered = 0.6;

/// Blocks in the order of the arrays may be this many times as wide as sorted ones; consecutive access makes
/// up for that.
inline constexpr double kStoredWell = 1.2;

/// Least and greatest reach of the candidate cache, as a fraction of the union's size: 1 and 10 mm of a body.
/// Beyond the reach candidates are found anew; each millimeter of it brings more candidates.
inline constexpr double kLeastReach = 1e-3, kMostReach = 12e-3;

/// Score above the distance of the nearest ellipsoid up to which the candidates of a particle certainly hold
/// its owner, in blend radii. More leaves fewer particles to be searched again, which costs each of them as
/// much as two others, and brings more candidates to all: the sum is flat from four to eight.
inline constexpr float kCertainScore = 6.0f;

/// Growth of the blocks' summed radii at which a new spatial sort pays its 10 ns a particle.
inline constexpr double kSortAgain = 1.3;

}  // namespace bodice::collision
