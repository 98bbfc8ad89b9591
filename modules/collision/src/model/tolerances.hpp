// Every tolerance of the module, each with its unit and its reason.
#pragma once

namespace bodice::collision {

/// Share of the scene's size by which a resolved particle may still lie below its clearance, and by which
/// pushes overshoot: results are stored as floats, whose rounding at that size is 6e-8 of it.
inline constexpr double kCertificate = 2e-7;

/// How far below the corrected surface a resolved particle may lie, share of relief's blending, which goes
/// with the body's stature: 5 micrometers of 3 mm, a tenth of what relief promises and a hundred times what
/// rounding does through tables of usual slope.
inline constexpr double kReliefCertificate = 5e-3 / 3.0;

/// Share of the scene's size by which float bounds are widened, so that culling never drops what exact
/// arithmetic would keep: a dozen roundings of 6e-8.
inline constexpr double kFloatRounding = 1e-6;

/// Share by which what bounds are taken from is larger than the ellipsoids, so that a processor's own
/// estimates of roots (off by up to 3.7e-4) do not lift a bound above the distance: as much as each ellipsoid
/// needs.
inline constexpr float kBoundGrowth = 5.5e-4f;

/// What the float solver's closest point and distance may be off by, share of the longest radius (or of the
/// distance from the center): nearly twice the worst of 120 million random cases (`response nearest`).
inline constexpr double kClosestPointError = 1e-6;

/// Cosine below which a ray runs along a surface rather than out of it.
inline constexpr double kFlatSlope = 1e-3;

/// Cosine of the angle between the surface normals at the two ends of a path: a particle that slides over a
/// limb turns by less than 60 degrees a call, one that tunnels by more.
inline constexpr double kSlidingCosine = 0.5;

/// Share of a path by which its ends may lie inside a body and still count as touching it.
inline constexpr double kEndSlack = 1e-2;

/// A push longer than this many times the depth comes from surfaces that nearly face each other; the way out
/// along the normal is shorter.
inline constexpr double kLongestPush = 4.0;

/// Depths that a push out of a crease is usually not longer than.
inline constexpr double kUsualPush = 1.5;

/// Rounds of cutting planes a particle: a body's creases join two or three ellipsoids, a bent surface takes
/// Newton two or three steps.
inline constexpr int kPlaneRounds = 10;

/// Of these the first look for the closest place even on a bent surface.
inline constexpr int kNearestRounds = 3;

/// Share of what is missing to the clearance to which the place midway between two surfaces is found.
inline constexpr double kMidway = 0.05;

/// Share of relief's blending by which pushes overshoot, so that Newton's steps over a bent surface arrive
/// from below: 6 micrometers of 3 mm.
inline constexpr double kReliefOvershoot = 2e-3;

/// Share of its length by which the first push out of relief goes further: what Newton's step is off by grows
/// with it, and one that falls short costs another query.
inline constexpr double kStepOvershoot = 1e-2;

/// The same for fillets, which are smooth: in certificates, so that what rests in one does not chatter.
inline constexpr double kFilletOvershoot = 20.0;

/// A path longer than this share of the shortest radius around may have changed sides.
inline constexpr double kLongPath = 0.3;

/// Least step along a path through relief, share of the union's size: a quarter of a millimeter of a body.
inline constexpr double kPathStep = 3e-4;

/// Share of the union's size by which a place found by halving lies on the clear side of it: relief jumps
/// where an ellipsoid's closest point changes sides, and floats must not tell another side there. A
/// micrometer.
inline constexpr double kBesideJump = 1e-6;

/// Depth, share of the union's size, up to which a place without room around is taken for a fold of the skin,
/// where limbs overlap: a centimeter of a body.
inline constexpr double kFoldDepth = 1e-2;

/// Share of another way's length from which on a ray out is worth following.
inline constexpr double kMuchShorter = 0.75;

/// Halvings of a ray between a particle and a clear place: of a meter, to a micrometer.
inline constexpr int kExitHalvings = 20;

/// Coordinates beyond this, meters, are not sorted with the rest and go to the exact side: their squares must
/// stay in float range over the smallest radius that a proxy may have.
inline constexpr float kFarthest_m = 1e9f;

/// Distance of particles half a block apart, relative to that of any two of a task, from which on sorting the
/// task by place pays: in no order it is 1, along a curve through space a quarter.
inline constexpr double kScattered = 0.6;

/// Blocks as the particles are stored may be this many times as wide as sorted ones: what storing in order
/// saves.
inline constexpr double kStoredWell = 1.2;

/// Least and longest way, share of the union's size, that places and material may come before the ellipsoids
/// near them are found anew: 1 and 10 mm of a body. Each millimeter brings more ellipsoids near.
inline constexpr double kLeastReach = 1e-3, kMostReach = 12e-3;

/// Growth of the blocks' summed radii that makes a new spatial sort worth its 10 ns a particle.
inline constexpr double kSortAgain = 1.3;

}  // namespace bodice::collision
