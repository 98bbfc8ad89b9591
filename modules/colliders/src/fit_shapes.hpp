// Shapes that go down the squared distance of points to their union.
#pragma once

#include <span>
#include <vector>

#include <bodice/colliders/reduce.hpp>

namespace bodice::inline v0_1::colliders {

/// The nearest shape of each point, and the sum of all squared distances weighted by area.
struct Assignment {
  std::vector<std::uint32_t> shape;    ///< #P
  std::vector<ShapeDistance> nearest;  ///< #P
  double sum = 0.0;
};

Assignment assign(const engine::Context& context, const SkinPoints& points,
                  std::span<const PlainShape> shapes);

/// A shape around some of the points: along their axis of greatest spread, with their mean distance from it
/// as radius. Precondition: some of `members` have area.
PlainShape shape_around(const SkinPoints& points, std::span<const std::uint32_t> members, ShapeKind kind);

/// The members on either side of the plane through their mean and across their axis of greatest spread.
std::array<std::vector<std::uint32_t>, 2> halves(const SkinPoints& points,
                                                 std::span<const std::uint32_t> members);

/// Takes so many damped Gauss-Newton steps, none of which makes the sum larger.
void descend(const engine::Context& context, const SkinPoints& points, ShapeKind kind, int steps,
             std::vector<PlainShape>& shapes, Assignment& current);

}  // namespace bodice::colliders
