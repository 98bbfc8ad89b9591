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
    ++rows_;
  }
  void add(const Eigen::VectorXd& x, double y) { add(x, Eigen::VectorXd::Constant(1, y)); }

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
  std::size_t rows_ = 0;
};

}  // namespace calibrate
