// A few plain shapes that stand for a proxy in an engine, fitted to the skin, and what that costs.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include <bodice/colliders/plain_shape.hpp>
#include <bodice/engine/context.hpp>
#include <bodice/engine/result.hpp>
#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::inline v0_1::colliders {

/// Points of the surface that shapes are fitted to and judged by: vertices, each with its share of the area
/// and the ellipsoid that owns it.
struct SkinPoints {
  std::vector<Vec3> position;        ///< #P, meters, y up
  std::vector<double> area;          ///< #P, a third of the triangles around it, square meters
  std::vector<std::uint32_t> owner;  ///< #P, into BodyProxy::ellipsoids()
};

/// The vertices of a mesh, of which those without a triangle count nothing. O(#P * #E).
SkinPoints skin_points(const engine::Context& context, const proxy::BodyProxy& proxy,
                       const geometry::TriMesh& mesh);

/// Most shapes that reduce() fits.
inline constexpr int kMaxShapes = 256;

/// Fits at most `count` shapes of a kind to the points: one a bone (of an unbound proxy: a part), of which
/// the worst is split again and again, and all of which go down the squared distance of the points together.
/// With fewer shapes than bones, the smallest bones share one. Each shape has the bone and part of most of
/// its points. Fails with kInvalidArgument where the count is not 1 to kMaxShapes, and with kUnusableGeometry
/// without points. Deterministic for any number of workers. Cost: 32 shapes take about a second.
engine::Result<std::vector<PlainShape>> reduce(const engine::Context& context, const proxy::BodyProxy& proxy,
                                               const SkinPoints& points, ShapeKind kind, int count);

/// Distances of points of the skin from a collider's surface, weighted by area. Meters.
struct SurfaceError {
  double mean_m = 0.0, p95_m = 0.0, worst_m = 0.0;  ///< spread of the absolute distance
  double area_m2 = 0.0;                             ///< 0: no points
};

/// The error of the whole collider, and of each part's skin.
struct ReductionCost {
  SurfaceError whole;
  std::array<SurfaceError, body::kAllPartCount> of_part;
};

/// The cost of shapes: a point's distance is its least signed distance to any of them, as engines have it.
ReductionCost cost_of(const engine::Context& context, const proxy::BodyProxy& proxy, const SkinPoints& points,
                      std::span<const PlainShape> shapes);
/// The cost of the proxy's ellipsoids, without relief and margin, which no engine has.
ReductionCost cost_of_ellipsoids(const engine::Context& context, const proxy::BodyProxy& proxy,
                                 const SkinPoints& points);

/// What a cost is the cost of, in words.
struct CostSubject {
  std::string format;     ///< "unity", ...
  std::string collider;   ///< "32 capsules", ...
  std::string reference;  ///< what the points belong to: a file, or "the proxy's surface"
};

/// The cost as one JSON object, in millimeters; parts without points are left out.
std::string cost_json(const proxy::BodyProxy& proxy, const ReductionCost& cost, const CostSubject& subject);

}  // namespace bodice::colliders
