// A quadric over a tangent plane, fitted to points around its origin.
#pragma once

#include <optional>

#include <Eigen/Dense>

#include <bodice/geometry/types.hpp>

namespace bodice::inline v0_1::geometry {

/// Least squares of a height over a plane by 1, u, v, u^2, u v and v^2; points are added one by one.
class Quadric {
 public:
  /// `scale`: the usual distance of the points, which conditions the equations.
  Quadric(const Vec3& origin, const Vec3& normal, double scale);

  void add(const Vec3& p);
  int count() const { return count_; }

  struct Value {
    double height = 0.0;    ///< where the quadric lies at the origin, along the normal
    double variance = 0.0;  ///< variance of that height where points have a variance of 1
    double residual = 0.0;  ///< mean squared deviation of the points, an unbiased estimate of their variance
  };
  /// Nothing for fewer points than kFewest, and where they lie on a conic.
  std::optional<Value> value() const;

  static constexpr int kFewest = 9;

 private:
  using Matrix = Eigen::Matrix<double, 6, 6>;
  using Vector = Eigen::Matrix<double, 6, 1>;

  Vec3 origin_, normal_, u_, v_;
  double scale_;
  Matrix squares_ = Matrix::Zero();
  Vector heights_ = Vector::Zero();
  double squared_heights_ = 0.0;
  int count_ = 0;
};

}  // namespace bodice::geometry
