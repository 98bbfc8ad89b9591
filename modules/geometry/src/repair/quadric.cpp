#include "repair/quadric.hpp"

#include <algorithm>

namespace bodice::inline v0_1::geometry {
namespace {

/// The least pivot of the equations, a mean over the points in their scale: below it they lie on a conic.
constexpr double kLeastPivot = 1e-6;

}  // namespace

Quadric::Quadric(const Vec3& origin, const Vec3& normal, double scale)
    : origin_(origin), normal_(normal), u_(normal.unitOrthogonal()), v_(normal.cross(u_)), scale_(scale) {}

void Quadric::add(const Vec3& p) {
  const Vec3 d = (p - origin_) / scale_;
  const double u = d.dot(u_), v = d.dot(v_), h = d.dot(normal_);
  Vector terms;
  terms << 1.0, u, v, u * u, u * v, v * v;
  squares_.noalias() += terms * terms.transpose();
  heights_ += h * terms;
  squared_heights_ += h * h;
  ++count_;
}

std::optional<Quadric::Value> Quadric::value() const {
  if (count_ < kFewest) return std::nullopt;
  const Eigen::LDLT<Matrix> factors(squares_);
  if (factors.info() != Eigen::Success || !(factors.vectorD().minCoeff() > kLeastPivot * count_))
    return std::nullopt;
  const Vector solution = factors.solve(heights_);
  const double rest = squared_heights_ - solution.dot(heights_);
  return Value{.height = scale_ * solution[0],
               .variance = factors.solve(Vector(Vector::Unit(0)))[0],
               .residual = scale_ * scale_ * std::max(rest, 0.0) / (count_ - 6)};
}

}  // namespace bodice::geometry
