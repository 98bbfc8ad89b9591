// Based on: Jean-Marc Thiery, Emilie Guy, Tamy Boubekeur. Sphere-Meshes: Shape Approximation using Spherical
// Quadric Error Metrics. 2013. - tapered capsules as hulls of two balls
// Differs: their parameters are found by least squares over points of the skin, not by contracting edges.
#include "fit_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Cholesky>

#include <bodice/engine/parallel.hpp>
#include <bodice/geometry/decompositions.hpp>

namespace bodice::inline v0_1::colliders {
namespace {

using Vec8 = Eigen::Matrix<double, 8, 1>;
using Mat8 = Eigen::Matrix<double, 8, 8>;

/// Points a task takes.
constexpr std::size_t kGrain = 512;
/// Shapes are not thinner than this, which is that of a child's finger.
constexpr double kLeastRadius_m = 0.002;

/// Columns are the directions that a kind may change in, in the space of (a, b, radius_a, radius_b).
Eigen::MatrixXd directions(ShapeKind kind) {
  Eigen::MatrixXd all = Eigen::MatrixXd::Identity(8, 8);
  if (kind == ShapeKind::kTaperedCapsule) return all;
  all.col(6) += all.col(7);
  if (kind == ShapeKind::kCapsule) return all.leftCols(7);
  Eigen::MatrixXd sphere(8, 4);
  sphere.leftCols(3) = all.leftCols(3) + all.middleCols(3, 3);
  sphere.col(3) = all.col(6);
  return sphere;
}

struct Spread {
  Vec3 mean = Vec3::Zero(), axis = Vec3::UnitY();
};

Spread spread_of(const SkinPoints& points, std::span<const std::uint32_t> members) {
  Spread spread;
  double area = 0.0;
  for (const std::uint32_t p : members)
    spread.mean += points.area[p] * points.position[p], area += points.area[p];
  spread.mean /= area;
  Mat3 moment = Mat3::Zero();
  for (const std::uint32_t p : members) {
    const Vec3 off = points.position[p] - spread.mean;
    moment += points.area[p] * off * off.transpose();
  }
  spread.axis = geometry::eigen_of_symmetric(moment).vectors.col(2);
  return spread;
}

/// The normal equations of every shape, over the points nearest to it.
struct NormalEquations {
  Mat8 matrix = Mat8::Zero();
  Vec8 gradient = Vec8::Zero();
};

std::vector<NormalEquations> normal_equations(const SkinPoints& points, const Assignment& current,
                                              std::size_t shapes) {
  std::vector<NormalEquations> all(shapes);
  for (std::size_t p = 0; p < points.position.size(); ++p) {
    const ShapeDistance& near = current.nearest[p];
    Vec8 row;  // the derivative of the distance; that of `along` vanishes, since it minimizes
    row << -(1.0 - near.along) * near.normal, -near.along * near.normal, -(1.0 - near.along), -near.along;
    NormalEquations& own = all[current.shape[p]];
    own.matrix += points.area[p] * row * row.transpose();
    own.gradient += points.area[p] * near.distance * row;
  }
  return all;
}

void move(PlainShape& shape, const Vec8& step) {
  shape.a += step.head<3>(), shape.b += step.segment<3>(3);
  shape.radius_a = std::max(kLeastRadius_m, shape.radius_a + step[6]);
  shape.radius_b = std::max(kLeastRadius_m, shape.radius_b + step[7]);
}

}  // namespace

Assignment assign(const engine::Context& context, const SkinPoints& points,
                  std::span<const PlainShape> shapes) {
  const std::vector<BoundingBall> balls = bounding_balls(shapes);
  Assignment found;
  const std::size_t count = points.position.size();
  found.shape.resize(count), found.nearest.resize(count);
  found.sum = engine::ordered_reduce(
      context, count, kGrain, 0.0,
      [&](std::size_t begin, std::size_t end) {
        double sum = 0.0;
        for (std::size_t p = begin; p < end; ++p) {
          double least = std::numeric_limits<double>::infinity();
          for (std::size_t s = 0; s < shapes.size(); ++s) {
            if (balls[s].is_farther(points.position[p], least)) continue;
            const ShapeDistance d = shape_distance(shapes[s], points.position[p]);
            if (!(d.distance < least)) continue;
            least = d.distance, found.nearest[p] = d;
            found.shape[p] = static_cast<std::uint32_t>(s);
          }
          sum += points.area[p] * least * least;
        }
        return sum;
      },
      [](double sum, double more) { return sum + more; });
  return found;
}

PlainShape shape_around(const SkinPoints& points, std::span<const std::uint32_t> members, ShapeKind kind) {
  const Spread spread = spread_of(points, members);
  double aside = 0.0, area = 0.0, low = 0.0, high = 0.0;
  for (const std::uint32_t p : members) {
    const Vec3 off = points.position[p] - spread.mean;
    const double along = off.dot(spread.axis);
    low = std::min(low, along), high = std::max(high, along);
    const double distance =
        kind == ShapeKind::kSphere ? off.norm() : std::sqrt(std::max(0.0, off.squaredNorm() - along * along));
    aside += points.area[p] * distance, area += points.area[p];
  }
  PlainShape shape;
  const double radius = std::max(kLeastRadius_m, aside / area);
  low = std::min(low + radius, 0.0), high = std::max(high - radius, 0.0);
  if (kind == ShapeKind::kSphere) low = high = 0.0;
  if (kind != ShapeKind::kSphere && high == low) low = -0.1 * radius, high = 0.1 * radius;
  shape.a = spread.mean + low * spread.axis, shape.b = spread.mean + high * spread.axis;
  shape.radius_a = shape.radius_b = radius;
  return shape;
}

std::array<std::vector<std::uint32_t>, 2> halves(const SkinPoints& points,
                                                 std::span<const std::uint32_t> members) {
  const Spread spread = spread_of(points, members);
  std::array<std::vector<std::uint32_t>, 2> sides;
  for (const std::uint32_t p : members)
    sides[(points.position[p] - spread.mean).dot(spread.axis) < 0.0 ? 0 : 1].push_back(p);
  return sides;
}

void descend(const engine::Context& context, const SkinPoints& points, ShapeKind kind, int steps,
             std::vector<PlainShape>& shapes, Assignment& current) {
  const Eigen::MatrixXd basis = directions(kind);
  double damping = 0.1;
  for (int step = 0; step < steps && damping < 1e6; ++step) {
    const std::vector<NormalEquations> equations = normal_equations(points, current, shapes.size());
    std::vector<PlainShape> moved = shapes;
    for (std::size_t s = 0; s < shapes.size(); ++s) {
      Eigen::MatrixXd matrix = basis.transpose() * equations[s].matrix * basis;
      const double scale = matrix.trace();
      if (!(scale > 0.0)) continue;  // no point is nearest to this shape
      matrix.diagonal() *= 1.0 + damping;
      matrix.diagonal().array() += 1e-4 * scale;
      const Eigen::VectorXd change = matrix.ldlt().solve(basis.transpose() * equations[s].gradient);
      move(moved[s], -basis * change);
    }
    Assignment next = assign(context, points, moved);
    if (next.sum < current.sum) {
      shapes = std::move(moved), current = std::move(next);
      damping = std::max(1e-3, 0.4 * damping);
    } else {
      damping *= 5.0;
    }
  }
}

}  // namespace bodice::colliders
