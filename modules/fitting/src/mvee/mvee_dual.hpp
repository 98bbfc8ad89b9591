// The dual of the enclosing-ellipsoid problem on a small active set.
// Based on: Michael J. Todd. Minimum-Volume Ellipsoids: Theory and Algorithms. 2016. - chapters 2 and 3
// (lifting q = (y, 1); maximize ln det sum u q q^T over the simplex; optimal when every
// kappa = q^T M^-1 q <= N).
// Based on: Radoslav Harman, Luc Pronzato. Improvements on removing nonoptimal support points in D-optimum
// design algorithms. 2007. - eq. (6) (which points cannot carry weight).
// Differs: the penalty N sum u replaces the simplex; it has the same optimum and needs no constraint. Steps
// are Newton's, projected on u >= 0. One that does not raise ln det is damped (the objective is
// self-concordant) and cut where the first weight vanishes. Multiplicative steps come first.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "mvee/small_cholesky.hpp"

namespace bodice::inline v0_1::fitting {

/// Points lifted to N = rank + 1 dimensions with their weights u, and the results of measure().
template <int N>
struct ActiveSet {
  static constexpr int kCapacity = 64;
  using Lifted = Eigen::Matrix<double, N, 1>;
  using Square = Eigen::Matrix<double, N, N>;
  using Weights = std::array<double, kCapacity>;

  Eigen::Matrix<double, N, kCapacity> q, z;  ///< points, and z = L^-1 q with M = L L^T
  Weights u{}, kappa{};
  int size = 0;
  double log_det = -std::numeric_limits<double>::infinity();  ///< ln det M

  bool full() const { return size == kCapacity; }
  void add(const Lifted& point, double weight) {
    q.col(size) = point;
    u[size++] = weight;
  }
  template <class Keep>
  void keep_if(Keep&& keep) {
    int kept = 0;
    for (int i = 0; i < size; ++i) {
      if (!keep(i)) continue;
      q.col(kept) = q.col(i);
      z.col(kept) = z.col(i);
      kappa[kept] = kappa[i];
      u[kept++] = u[i];
    }
    size = kept;
  }
  void drop_idle() {
    keep_if([this](int i) { return u[i] > 0.0; });
  }
  void normalize() {
    double sum = 0.0;
    for (int i = 0; i < size; ++i) sum += u[i];
    for (int i = 0; i < size; ++i) u[i] /= sum;
  }
  Square moment() const {
    Square m = Square::Zero();
    for (int i = 0; i < size; ++i)
      if (u[i] > 0.0) m += (u[i] * q.col(i)) * q.col(i).transpose();
    return m;
  }
  /// Normalizes the weights and finds z, kappa and log_det; false if M is not positive definite.
  bool measure() {
    normalize();
    const Eigen::LLT<Square> llt(moment());
    if (llt.info() != Eigen::Success) return false;
    const Square l = llt.matrixL();
    double diagonal = 1.0;
    for (int j = 0; j < N; ++j) diagonal *= l(j, j);
    log_det = 2.0 * std::log(diagonal);
    Square inverse = Square::Zero();
    for (int c = 0; c < N; ++c)
      for (int r = c; r < N; ++r) {
        double sum = r == c ? 1.0 : 0.0;
        for (int k = c; k < r; ++k) sum -= l(r, k) * inverse(k, c);
        inverse(r, c) = sum / l(r, r);
      }
    for (int i = 0; i < size; ++i) {
      z.col(i).noalias() = inverse.lazyProduct(q.col(i));
      kappa[i] = z.col(i).squaredNorm();
    }
    return std::isfinite(log_det);
  }
  /// The largest kappa / N - 1; the duality gap is at most N/2 times this.
  double excess() const { return kappa[worst()] / N - 1.0; }
  int worst() const {
    return static_cast<int>(std::max_element(kappa.begin(), kappa.begin() + size) - kappa.begin());
  }
};

/// Removes the points that cannot carry weight in the solution of this set, which the excess decides. They
/// stay if the others would not span the space. The set is measured afterward.
template <int N>
void drop_weightless(ActiveSet<N>& set, double excess) {
  const double root = std::sqrt(std::max(0.0, excess * (4.0 + excess - 4.0 / N)));
  // The bound is lowered a little, so that no point on it is removed by the rounding of kappa.
  const double bound = N * (1.0 + 0.5 * excess - 0.5 * root) * (1.0 - 1e-9);
  if (*std::min_element(set.kappa.begin(), set.kappa.begin() + set.size) >= bound) return;
  const ActiveSet<N> before = set;
  set.keep_if([&](int i) { return set.kappa[i] >= bound; });
  constexpr double kMostLost = 1.0;  // fall of ln det
  if (set.size == 0 || !set.measure() || set.log_det < before.log_det - kMostLost) set = before;
}

/// Finds Newton's direction over the weights that are positive or should be, because kappa exceeds N; it is
/// zero for the others. Returns the Newton decrement, or a negative number if the system could not be solved.
template <int N>
double newton_direction(const ActiveSet<N>& set, typename ActiveSet<N>::Weights& direction) {
  using Set = ActiveSet<N>;
  std::array<int, Set::kCapacity> free;
  int m = 0;
  for (int i = 0; i < set.size; ++i)
    if (set.u[i] > 0.0 || set.kappa[i] > N) free[m++] = i;
  double decrement = -1.0;
  constexpr int kAttempts = 4;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    SmallCholesky<Set::kCapacity> h(m);
    typename Set::Weights d;
    for (int a = 0; a < m; ++a) {
      for (int b = 0; b <= a; ++b) {
        const double along = set.z.col(free[a]).dot(set.z.col(free[b]));
        h(a, b) = along * along;
      }
      d[a] = set.kappa[free[a]] - N;
    }
    // K o K has rank at most N (N + 1) / 2. The gradient lies in its range, so that a small ridge is
    // harmless.
    h.add_ridge(1e-11);
    if (!h.factor()) return -1.0;
    h.solve(d.data());
    double squared = 0.0;
    direction.fill(0.0);
    int kept = 0;
    for (int a = 0; a < m; ++a) {
      if (!std::isfinite(d[a])) return -1.0;
      squared += d[a] * (set.kappa[free[a]] - N);
      const bool points_out = set.u[free[a]] == 0.0 && d[a] <= 0.0;
      if (!points_out) direction[free[a]] = d[a], free[kept++] = free[a];
    }
    decrement = std::sqrt(std::max(0.0, squared));
    if (kept == m) break;
    m = kept;
  }
  return decrement;
}

/// Moves along `direction` as far as self-concordance and u >= 0 allow; a weight that reaches zero is exactly
/// zero.
template <int N>
void cut_step(ActiveSet<N>& set, const typename ActiveSet<N>::Weights& direction, double decrement) {
  double length = decrement < 0.25 ? 1.0 : 1.0 / (1.0 + decrement);
  int blocking = -1;
  for (int i = 0; i < set.size; ++i)
    if (direction[i] < 0.0 && set.u[i] <= -length * direction[i]) {
      length = -set.u[i] / direction[i];
      blocking = i;
    }
  for (int i = 0; i < set.size; ++i) set.u[i] = std::max(0.0, set.u[i] + length * direction[i]);
  if (blocking >= 0) set.u[blocking] = 0.0;
}

/// Takes a whole Newton step, projected on u >= 0, if that raises ln det, else a damped one. The set is
/// measured afterward; false if that fails.
template <int N>
bool newton_step(ActiveSet<N>& set) {
  typename ActiveSet<N>::Weights direction;
  const double decrement = newton_direction(set, direction);
  if (decrement < 0.0) return false;
  const typename ActiveSet<N>::Weights before = set.u;
  const double log_det_before = set.log_det;
  for (int i = 0; i < set.size; ++i) set.u[i] = std::max(0.0, set.u[i] + direction[i]);
  if (set.measure() && set.log_det >= log_det_before) return true;
  set.u = before;
  cut_step(set, direction, decrement);
  return set.measure();
}

/// One Wolfe-Atwood step: toward the worst point, or away from the least useful one. ln det never falls.
template <int N>
void wolfe_atwood_step(ActiveSet<N>& set) {
  const int worst = set.worst();
  int least = -1;
  for (int i = 0; i < set.size; ++i) {
    if (set.u[i] > 0.0 && (least < 0 || set.kappa[i] < set.kappa[least])) least = i;
  }
  const bool away = N - set.kappa[least] > set.kappa[worst] - N;
  const int i = away ? least : worst;
  double step = (set.kappa[i] - N) / (N * (set.kappa[i] - 1.0));
  if (away) step = std::max(step, -set.u[i] / (1.0 - set.u[i]));
  if (!std::isfinite(step)) return;
  for (int j = 0; j < set.size; ++j) set.u[j] *= 1.0 - step;
  set.u[i] = away && set.u[i] + step < 1e-15 ? 0.0 : set.u[i] + step;
}

/// Maximizes the dual on the active set until the set's excess is below `tolerance`, with bounded work.
/// Returns the excess reached.
template <int N>
double maximize_dual(ActiveSet<N>& set, double tolerance) {
  constexpr int kNewtonSteps = 80, kFirstOrderSteps = 2000;
  double reached = 1e300;
  if (!set.measure()) return reached;
  for (int step = 0; step < kNewtonSteps + kFirstOrderSteps; ++step) {
    reached = set.excess();
    if (reached <= tolerance) break;
    if (step < kNewtonSteps && reached <= 0.5) {
      drop_weightless(set, reached);
      if (newton_step(set)) continue;
      if (!set.measure()) return reached;
    }
    const bool enters = set.u[set.worst()] == 0.0;  // a multiplicative step cannot change a zero
    if (step < kNewtonSteps && reached > 0.5 && !enters) {
      // Far from the optimum, cheap multiplicative steps gain more than Newton's.
      for (int i = 0; i < set.size; ++i) set.u[i] *= set.kappa[i] / N;
    } else {
      wolfe_atwood_step(set);
    }
    if (!set.measure()) return reached;
  }
  return reached;
}

}  // namespace bodice::fitting
