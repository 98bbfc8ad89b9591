#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include <bodice/colliders/convex_pieces.hpp>
#include <bodice/engine/parallel.hpp>
#include <bodice/geometry/decompositions.hpp>
#include <bodice/geometry/mesh_distance.hpp>

#include "cost_by.hpp"
#include "fit_shapes.hpp"

namespace bodice::inline v0_1::colliders {
namespace {

using Members = std::vector<std::uint32_t>;

/// A point belongs to every capsule that is nearly as near as the nearest one.
constexpr double kOverlap_m = 0.004;
constexpr std::size_t kFewest = 8;  // points of a piece

/// Directions spread evenly over the sphere.
Vec3 spiral_direction(int k, int count) {
  const double y = 1.0 - (2.0 * k + 1.0) / count, radius = std::sqrt(1.0 - y * y);
  const double turn = std::numbers::pi * (3.0 - std::sqrt(5.0)) * k;
  return {radius * std::cos(turn), y, radius * std::sin(turn)};
}

/// The farthest of the members in each direction of a space in which they spread alike on all sides.
std::vector<Vec3> farthest_points(const SkinPoints& points, const Members& members) {
  Vec3 mean = Vec3::Zero();
  for (const std::uint32_t p : members) mean += points.position[p] / static_cast<double>(members.size());
  Mat3 moment = Mat3::Zero();
  for (const std::uint32_t p : members) {
    const Vec3 off = points.position[p] - mean;
    moment += off * off.transpose() / static_cast<double>(members.size());
  }
  const geometry::SymmetricEigen eigen = geometry::eigen_of_symmetric(moment);
  const Vec3 spread = eigen.values.cwiseMax(1e-12).cwiseSqrt();
  const Mat3 even = spread.cwiseInverse().asDiagonal() * eigen.vectors.transpose();
  Members chosen;
  for (int k = 0; k < kMostCorners; ++k) {
    const Vec3 along = even.transpose() * spiral_direction(k, kMostCorners);
    chosen.push_back(*std::ranges::max_element(
        members, {}, [&](std::uint32_t p) { return along.dot(points.position[p] - mean); }));
  }
  std::ranges::sort(chosen);
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  std::vector<Vec3> corners;
  for (const std::uint32_t p : chosen) corners.push_back(points.position[p]);
  return corners;
}

std::vector<Members> overlapping_groups(const engine::Context& context, const SkinPoints& points,
                                        std::span<const PlainShape> shapes) {
  const std::vector<BoundingBall> balls = bounding_balls(shapes);
  const Assignment nearest = assign(context, points, shapes);
  std::vector<Members> groups(shapes.size());
  for (std::uint32_t p = 0; p < points.position.size(); ++p)
    for (std::size_t s = 0; points.area[p] > 0.0 && s < shapes.size(); ++s) {
      const double reach_m = nearest.nearest[p].distance + kOverlap_m;
      if (!balls[s].is_farther(points.position[p], reach_m) &&
          shape_distance(shapes[s], points.position[p]).distance <= reach_m)
        groups[s].push_back(p);
    }
  return groups;
}

}  // namespace

engine::Result<std::vector<ConvexPiece>> convex_pieces(const engine::Context& context,
                                                       const proxy::BodyProxy& proxy,
                                                       const SkinPoints& points, int count) {
  const auto shapes = reduce(context, proxy, points, ShapeKind::kCapsule, count);
  if (!shapes) return shapes.error();
  const std::vector<Members> groups = overlapping_groups(context, points, *shapes);
  std::vector<ConvexPiece> pieces(groups.size());
  engine::parallel_for(context, groups.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t g = begin; g < end; ++g) {
      if (groups[g].size() >= kFewest) pieces[g].mesh = convex_hull(farthest_points(points, groups[g]));
      pieces[g].part = (*shapes)[g].part, pieces[g].bone = (*shapes)[g].bone;
    }
  });
  std::erase_if(pieces, [](const ConvexPiece& piece) { return piece.mesh.empty(); });
  return pieces;
}

ReductionCost cost_of_pieces(const engine::Context& context, const proxy::BodyProxy& proxy,
                             const SkinPoints& points, std::span<const ConvexPiece> pieces) {
  std::vector<geometry::MeshDistance> distances;
  for (const ConvexPiece& piece : pieces) distances.emplace_back(context, piece.mesh);
  return cost_by(context, proxy, points, [&](const Vec3& point) {
    double least = std::numeric_limits<double>::infinity();
    for (const geometry::MeshDistance& distance : distances)
      least = std::min(least, distance.signed_distance(point));
    return least;
  });
}

}  // namespace bodice::colliders
