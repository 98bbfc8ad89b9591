// Linear least squares over many rows.
#pragma once

#include <Eigen/Cholesky>

namespace calibrate {

/// Collects rows x . w = y and solves for w.
class LeastSquares {
 public:
  explicit LeastSquares(int unknowns, int targets = 1)
      : square_(Eigen::MatrixXd::Zero(unknowns, unknowns)),
        right_(Eigen::MatrixXd::Zero(unknowns, targets)) {}

  void add(const Eigen::VectorXd& x, const Eigen::VectorXd& y) {
    square_.noalias() += x * x.transpose();
    right_.noalias() += x * y.transpose();
    squares_ += y.squaredNorm();
    ++rows_;
  }
  void add(const Eigen::VectorXd& x, double y) { add(x, Eigen::VectorXd::Constant(1, y)); }

  LeastSquares& operator+=(const LeastSquares& other) {
    square_ += other.square_;
    right_ += other.right_;
    squares_ += other.squares_;
    rows_ += other.rows_;
    return *this;
  }
  int unknowns() const { return static_cast<int>(square_.rows()); }
  std::size_t rows() const { return rows_; }
  /// The sum over the rows of (x . weights - y)^2.
  double squared_error(const Eigen::MatrixXd& weights) const {
    return squares_ - 2.0 * weights.cwiseProduct(right_).sum() +
           weights.cwiseProduct(square_ * weights).sum();
  }
  /// #unknowns x #targets. `ridge`: what a squared weight costs, as a share of a row; it settles what the
  /// rows leave open.
  Eigen::MatrixXd solve(double ridge) const {
    return solve(Eigen::VectorXd::Constant(square_.rows(), ridge));
  }
  /// The same with a ridge for each unknown.
  Eigen::MatrixXd solve(const Eigen::VectorXd& ridge) const {
    Eigen::MatrixXd square = square_;
    square.diagonal() += static_cast<double>(rows_) * ridge;
    return square.ldlt().solve(right_);
  }

 private:
  Eigen::MatrixXd square_, right_;
  double squares_ = 0.0;  ///< the sum of all |y|^2
  std::size_t rows_ = 0;
};

}  // namespace calibrate
