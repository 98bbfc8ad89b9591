// A quadric over a tangent plane, fitted to points around its origin.
#pragma once

#include <optional>
#include <span>

#include <Eigen/Dense>

#include <bodice/geometry/types.hpp>

namespace bodice::inline v0_1::geometry {

/// A quadric as it was fitted, with its uncertainty.
class QuadricPatch {
 public:
  /// How far a point has to move along the patch's normal to lie on it, and the variance of that where points
  /// have a variance of 1.
  struct Offset {
    double distance, variance;
  };
  Offset offset(const Vec3& p) const;
  const Vec3& normal() const { return normal_; }

 private:
  friend class Quadric;
  Vec3 origin_, normal_, u_, v_;  // u and v are divided by the scale
  Eigen::Matrix<double, 6, 1> heights_;
  Eigen::Matrix<double, 6, 6> covariance_;
};

/// Least squares of a height over a plane by 1, u, v, u^2, u v and v^2; points are added bit by bit.
class Quadric {
 public:
  /// `scale`: the usual distance of the points, which conditions the equations.
  Quadric(const Vec3& origin, const Vec3& normal, double scale);

  /// Adds some of the positions.
  void add(std::span<const Index> points, std::span<const Vec3> positions);
  int count() const { return count_; }

  struct Value {
    double height = 0.0;    ///< where the quadric lies at the origin, along the normal
    double variance = 0.0;  ///< variance of that height where points have a variance of 1
    double residual = 0.0;  ///< mean squared deviation of the points, an unbiased estimate of their variance
  };
  /// Nothing for fewer points than kFewest, and where they lie on a conic.
  std::optional<Value> value() const;

  /// The quadric itself. Precondition: value() gives something.
  QuadricPatch patch() const;

  static constexpr int kFewest = 9;

  /// Sums that a quadric is solved from, weighed by how many points each of `count` rows stands for.
  struct Sums {
    const Eigen::Matrix<double, 6, 6>& squares;
    const Eigen::Matrix<double, 6, 1>& heights;
    double squared_heights = 0.0;
    int count = 0;
  };
  /// Nothing where the points lie on a conic.
  static std::optional<Value> solve(const Sums& sums, double scale);

 private:
  /// Sums over the points of u^i v^j, and of the height times each term.
  struct Moments {
    double u = 0, v = 0, uu = 0, uv = 0, vv = 0, uuu = 0, uuv = 0, uvv = 0, vvv = 0;
    double uuuu = 0, uuuv = 0, uuvv = 0, uvvv = 0, vvvv = 0;
    double h = 0, hu = 0, hv = 0, huu = 0, huv = 0, hvv = 0, hh = 0;
  };

  using Matrix = Eigen::Matrix<double, 6, 6>;
  using Vector = Eigen::Matrix<double, 6, 1>;
  Matrix squares() const;
  Vector heights() const;

  Vec3 origin_, normal_, u_, v_;  // the axes divided by the scale
  double scale_;
  Moments sum_;
  int count_ = 0;
};

}  // namespace bodice::geometry
