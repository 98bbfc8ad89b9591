// Linear least squares over many rows.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Cholesky>

namespace calibrate {

/// People are left out of a fit in this many parts, one after the other, to choose the ridge.
inline constexpr std::size_t kFolds = 5;
/// Rounds in which rows count by what the round before left of their errors; it has settled by then.
inline constexpr int kReweighted = 12;

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
    rows_ += 1.0;
  }
  void add(const Eigen::VectorXd& x, double y) { add(x, Eigen::VectorXd::Constant(1, y)); }
  /// The same as so many rows.
  void add(const Eigen::VectorXd& x, double y, double weight) {
    square_.noalias() += weight * x * x.transpose();
    right_.noalias() += weight * y * x;
    squares_ += weight * y * y;
    rows_ += weight;
  }

  LeastSquares& operator+=(const LeastSquares& other) {
    square_ += other.square_;
    right_ += other.right_;
    squares_ += other.squares_;
    rows_ += other.rows_;
    return *this;
  }
  int unknowns() const { return static_cast<int>(square_.rows()); }
  double rows() const { return rows_; }
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
    square.diagonal() += rows_ * ridge;
    return square.ldlt().solve(right_);
  }

 private:
  Eigen::MatrixXd square_, right_;
  double squares_ = 0.0;  ///< the sum of all |y|^2
  double rows_ = 0.0;
};

/// A system for each part of the people, so that each part can be left out.
class FoldedLeastSquares {
 public:
  explicit FoldedLeastSquares(int unknowns) : folds_(kFolds, LeastSquares(unknowns)) {}

  void add(std::size_t person, const Eigen::VectorXd& x, double y) { folds_[person % kFolds].add(x, y); }

  /// The weights by all people but those of a part; kFolds: by all. The ridge is one for all unknowns, or one
  /// for each.
  template <class Ridge>
  Eigen::VectorXd solve(const Ridge& ridge, std::size_t without = kFolds) const {
    LeastSquares all(folds_.front().unknowns());
    for (std::size_t fold = 0; fold < kFolds; ++fold)
      if (fold != without) all += folds_[fold];
    return all.solve(ridge).col(0);
  }
  /// Root mean square error on the people left out.
  double left_out_error(double ridge) const {
    double squares = 0.0, rows = 0.0;
    for (std::size_t fold = 0; fold < kFolds; ++fold) {
      if (folds_[fold].rows() == 0.0) continue;
      squares += folds_[fold].squared_error(solve(ridge, fold));
      rows += folds_[fold].rows();
    }
    return std::sqrt(squares / rows);
  }
  /// The one of `ridges` that errs least on people left out.
  double best_ridge(std::span<const double> ridges) const {
    double best = ridges.front();
    for (const double other : ridges)
      if (left_out_error(other) < left_out_error(best)) best = other;
    return best;
  }

 private:
  std::vector<LeastSquares> folds_;
};

}  // namespace calibrate
