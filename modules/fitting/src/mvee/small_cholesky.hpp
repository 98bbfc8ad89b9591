// A dense symmetric system of a dozen unknowns on the stack, too small for a library's blocking to pay.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace bodice::inline v0_1::fitting {

/// The factors A = L L^T of a matrix of order at most Capacity: the lower triangle, row by row.
template <int Capacity>
class SmallCholesky {
 public:
  explicit SmallCholesky(int order) : order_(order) {}

  double& operator()(int row, int column) { return a_[static_cast<std::size_t>(row * Capacity + column)]; }

  /// Adds `relative` times the largest diagonal entry to the diagonal.
  void add_ridge(double relative) {
    double largest = 0.0;
    for (int i = 0; i < order_; ++i) largest = std::max(largest, (*this)(i, i));
    for (int i = 0; i < order_; ++i) (*this)(i, i) += relative * largest;
  }

  /// Replaces A by L; false if A is not positive definite.
  bool factor() {
    for (int i = 0; i < order_; ++i) {
      double* const row = &(*this)(i, 0);
      for (int j = 0; j <= i; ++j) {
        const double* const other = &(*this)(j, 0);
        double sum = row[j];
        for (int k = 0; k < j; ++k) sum -= row[k] * other[k];
        if (j < i) {
          row[j] = sum * inverse_diagonal_[static_cast<std::size_t>(j)];
        } else {
          if (!(sum > 0.0)) return false;
          inverse_diagonal_[static_cast<std::size_t>(i)] = 1.0 / std::sqrt(sum);
        }
      }
    }
    return true;
  }

  /// b <- A^-1 b, after factor().
  void solve(double* b) const {
    const auto at = [this](int i, int j) { return a_[static_cast<std::size_t>(i * Capacity + j)]; };
    for (int i = 0; i < order_; ++i) {
      for (int k = 0; k < i; ++k) b[i] -= at(i, k) * b[k];
      b[i] *= inverse_diagonal_[static_cast<std::size_t>(i)];
    }
    for (int i = order_ - 1; i >= 0; --i) {
      for (int k = i + 1; k < order_; ++k) b[i] -= at(k, i) * b[k];
      b[i] *= inverse_diagonal_[static_cast<std::size_t>(i)];
    }
  }

 private:
  int order_;
  std::array<double, static_cast<std::size_t>(Capacity* Capacity)> a_;
  std::array<double, Capacity> inverse_diagonal_;
};

}  // namespace bodice::fitting
