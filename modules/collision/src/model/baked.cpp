#include "model/baked.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <numeric>

#include "model/tolerances.hpp"

namespace bodice::inline v0_1::collision {

using geometry::Ellipsoid;
using geometry::Vec3;

namespace {

BakedEllipsoid bake(const Ellipsoid& shape) {
  const std::array<int, 3> axes = geometry::axes_by_radius(shape.radii);
  const double r0 = shape.radii[axes[0]];
  const double r1 = shape.radii[axes[1]] / r0;
  const double r2 = shape.radii[axes[2]] / r0;
  BakedEllipsoid result;
  for (int row = 0; row < 3; ++row) {
    result.center[row] = static_cast<float>(shape.center[row]);
    for (int column = 0; column < 3; ++column)
      result.to_unit[3 * row + column] = static_cast<float>(shape.axes(column, axes[row]) / r0);
  }
  result.radius1 = static_cast<float>(r1);
  result.radius2 = static_cast<float>(r2);
  result.gap0 = static_cast<float>((1.0 - r2) * (1.0 + r2));
  result.gap1 = static_cast<float>((r1 - r2) * (r1 + r2));
  result.inverse1 = static_cast<float>(1.0 / r1);
  result.inverse2 = static_cast<float>(1.0 / r2);
  result.longest_m = static_cast<float>(r0);
  return result;
}

BallMap bake_ball(const Ellipsoid& shape) {
  const geometry::Mat3 to_ball = shape.radii.cwiseInverse().asDiagonal() * shape.axes.transpose();
  const Vec3 offset = -(to_ball * shape.center);
  BallMap result;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      result.to_ball[3 * row + column] = static_cast<float>(to_ball(row, column));
    result.offset[row] = static_cast<float>(offset[row]);
    result.inverse_radius[row] = static_cast<float>(1.0 / shape.radii[row]);
  }
  return result;
}

BallMap grown(const BallMap& given) {
  BallMap ball = given;
  const auto shrink = [](auto& numbers) {
    for (float& number : numbers) number *= 1.0f / (1.0f + kBoundGrowth);
  };
  shrink(ball.to_ball);
  shrink(ball.offset);
  shrink(ball.inverse_radius);
  return ball;
}

}  // namespace

Baked::Baked(const std::vector<Ellipsoid>& shapes, const std::vector<geometry::Box>& boxes,
             const std::vector<std::uint32_t>& proxy_indices)
    : proxy_index(proxy_indices.begin(), proxy_indices.end()) {
  internal_index.resize(proxy_index.size());
  for (std::size_t k = 0; k < proxy_index.size(); ++k)
    internal_index[static_cast<std::size_t>(proxy_index[k])] = static_cast<std::int32_t>(k);
  const std::size_t padded = (shapes.size() + kPad - 1) / kPad * kPad;
  // The padding is farther away than any search window.
  const float nowhere = std::numeric_limits<float>::max();
  ellipsoids.resize(shapes.size());
  balls.resize(shapes.size());
  bounds.resize(shapes.size());
  for (std::vector<float>& values : cull.ball) values.assign(padded, 0.0f);
  for (int axis = 0; axis < 3; ++axis) {
    cull.ball[kBallOffset + axis].assign(padded, 1e18f);
    cull.ball[kBallInverse + axis].assign(padded, 1.0f);
  }
  for (int axis = 0; axis < 3; ++axis) {
    cull.low[axis].assign(padded, nowhere);
    cull.high[axis].assign(padded, nowhere);
  }
  cull.shortest.assign(padded, 0.0f);
  const std::size_t groups = padded / kGroup + kPad;  // vectors of groups are read from any index
  for (int axis = 0; axis < 3; ++axis) {
    cull.group_low[axis].assign(groups, nowhere);
    cull.group_high[axis].assign(groups, nowhere);
  }
  for (std::vector<float>& values : cull.baked) values.assign(padded, 1.0f);
  update(shapes, boxes);
}

void Baked::update(const std::vector<Ellipsoid>& shapes, const std::vector<geometry::Box>& boxes) {
  double size_m = 0.0;
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    ellipsoids[k] = bake(shapes[k]);
    balls[k] = bake_ball(shapes[k]);
    ellipsoids[k].proxy_index = balls[k].proxy_index = proxy_index[k];
    bounds[k] = grown(balls[k]);
    const float* const ball = balls[k].to_ball;  // the members follow each other without padding
    for (std::size_t i = 0; i < kBallFloats; ++i) cull.ball[i][k] = ball[i];
    const geometry::Box& box = boxes[k];
    for (int axis = 0; axis < 3; ++axis) {
      cull.low[axis][k] = static_cast<float>(box.low[axis]);
      cull.high[axis][k] = static_cast<float>(box.high[axis]);
      float &low = cull.group_low[axis][k / kGroup], &high = cull.group_high[axis][k / kGroup];
      low = k % kGroup == 0 ? cull.low[axis][k] : std::min(low, cull.low[axis][k]);
      high = k % kGroup == 0 ? cull.high[axis][k] : std::max(high, cull.high[axis][k]);
    }
    cull.shortest[k] = static_cast<float>(shapes[k].radii.minCoeff());
    size_m = std::max({size_m, box.low.cwiseAbs().maxCoeff(), box.high.cwiseAbs().maxCoeff()});
  }
  rounding_m = static_cast<float>(kFloatRounding * size_m);
  // A pass of its own, because a processor waits for what it has just written in parts to be read as a whole.
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    const auto values = std::bit_cast<std::array<float, kBakedFloats>>(ellipsoids[k]);
    for (std::size_t i = 0; i < kShapeFloats; ++i) cull.baked[i][k] = values[i];
  }
}

}  // namespace bodice::collision
