// A body proxy in the form that the kernels read: floats in a local frame.
#pragma once

#include <cstdint>
#include <vector>

#include <bodice/geometry/ellipsoid.hpp>

namespace bodice::inline v0_1::collision {

/// One ellipsoid for the closest-point solver. Axes are ordered by falling radius, and lengths are in units
/// of the longest radius r0, so that the solver's squares stay in range for any radius: y = to_unit (p -
/// center), |y| = 1 at r0.
struct BakedEllipsoid {
  float center[3];           ///< meters
  float to_unit[9];          ///< rows: unit axes / r0, 1/meters
  float radius1, radius2;    ///< r1 / r0 and r2 / r0, in (0, 1]
  float gap0, gap1;          ///< 1 - radius2^2 and radius1^2 - radius2^2: zero for a sphere
  float inverse1, inverse2;  ///< 1 / radius1, 1 / radius2
  float longest_m;           ///< r0
  std::int32_t proxy_index;  ///< index in the proxy
};
inline constexpr int kBakedFloats = sizeof(BakedEllipsoid) / sizeof(float);
inline constexpr int kShapeFloats = kBakedFloats - 1;  ///< without proxy_index

/// One ellipsoid as the unit ball: u = to_ball p + offset is the image of p.
struct alignas(64) BallMap {
  float to_ball[9];          ///< diag(1 / r) R^T, 1/meters
  float offset[3];           ///< - to_ball c
  float inverse_radius[3];   ///< 1/meters
  std::int32_t proxy_index;  ///< index in the proxy
};
inline constexpr int kBallFloats = 15, kBallOffset = 9, kBallInverse = 12;  ///< without proxy_index

/// The same numbers with boxes and inner balls, one array a number, so that sixteen ellipsoids are read at
/// once. The arrays are padded to kPad with boxes infinitely far away. Neighbors in space should be neighbors
/// here.
struct CullArrays {
  std::vector<float> baked[kShapeFloats];  ///< the members of BakedEllipsoid, in order
  std::vector<float> ball[kBallFloats];    ///< the members of BallMap, in order
  std::vector<float> low[3], high[3];      ///< meters
  std::vector<float> shortest;             ///< r2, meters: radius of the inner ball
  /// Boxes of the groups of kGroup consecutive ellipsoids, meters; padded likewise.
  std::vector<float> group_low[3], group_high[3];
};

/// Number of ellipsoids in a group of the broad phase: the floats of the widest vector.
inline constexpr int kGroup = 16;

/// A proxy's ellipsoids in every form that the kernels read.
struct Baked {
  static constexpr std::size_t kPad = kGroup;

  Baked(const std::vector<geometry::Ellipsoid>& shapes, const std::vector<geometry::Box>& boxes,
        const std::vector<std::uint32_t>& proxy_indices);
  /// Replaces the shapes by as many others; allocates nothing.
  void update(const std::vector<geometry::Ellipsoid>& shapes, const std::vector<geometry::Box>& boxes);

  std::size_t size() const { return ellipsoids.size(); }

  std::vector<BakedEllipsoid> ellipsoids;
  std::vector<BallMap> balls;
  std::vector<BallMap> bounds;            ///< maps of the ellipsoids grown by kBoundGrowth, for lower bounds
  std::vector<std::int32_t> proxy_index;  ///< index of each ellipsoid in the proxy
  std::vector<std::int32_t>
      internal_index;  ///< the inverse: index in these arrays of each ellipsoid of the proxy
  CullArrays cull;
  float rounding_m = 0.0f;  ///< error of float arithmetic at the union's size
};

}  // namespace bodice::collision
