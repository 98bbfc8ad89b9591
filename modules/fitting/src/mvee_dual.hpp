// The dual of the enclosing-ellipsoid problem on a small active set.
// Based on: Michael J. Todd. Minimum-Volume Ellipsoids: Theory and Algorithms. 2016. - chapters 2 and 3
// (lifting q = (y, 1); maximise ln det sum u q q^T over the simplex; optimal when every
// kappa = q^T M^-1 q <= N). Differs: the simplex is replaced by the penalty N sum u, which has the same
// optimum and needs no constraint; steps are damped Newton (the objective is self-concordant) with an active
// set on u >= 0; multiplicative steps warm it up.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace bodice::fitting {

/// Points lifted to N = rank + 1 dimensions with their weights u.
template <int N>
struct ActiveSet {
  static constexpr int kCapacity = 64;
  using Lifted = Eigen::Matrix<double, N, 1>;
  using Square = Eigen::Matrix<double, N, N>;
  using Lifteds = Eigen::Matrix<double, N, Eigen::Dynamic, Eigen::ColMajor, N, kCapacity>;
  using Weights = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kCapacity, 1>;
  using Hessian =
      Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kCapacity, kCapacity>;

  Eigen::Matrix<double, N, kCapacity> q;
  Eigen::Matrix<double, kCapacity, 1> u;
  int size = 0;

  bool full() const { return size == kCapacity; }
  void add(const Lifted& point, double weight) {
    q.col(size) = point;
    u[size++] = weight;
  }
  void drop_idle() {
    int kept = 0;
    for (int i = 0; i < size; ++i)
      if (u[i] > 0.0) {
        q.col(kept) = q.col(i);
        u[kept++] = u[i];
      }
    size = kept;
  }
  void normalise() { u.head(size) /= u.head(size).sum(); }
  Square moment() const {
    return q.leftCols(size) * u.head(size).asDiagonal() * q.leftCols(size).transpose();
  }
};

/// L^-1 q of every active point, so that kappa are squared column norms; false if M is not positive definite.
template <int N>
bool whitened(const ActiveSet<N>& set, typename ActiveSet<N>::Lifteds& z) {
  const Eigen::LLT<typename ActiveSet<N>::Square> llt(set.moment());
  if (llt.info() != Eigen::Success) return false;
  z = set.q.leftCols(set.size);
  llt.matrixL().solveInPlace(z);
  return z.allFinite();
}

/// One Newton direction on the free weights; entering weights whose direction points out are freed of it.
template <int N>
typename ActiveSet<N>::Weights newton_direction(const ActiveSet<N>& set,
                                                const typename ActiveSet<N>::Lifteds& z,
                                                const typename ActiveSet<N>::Weights& kappa, int entering,
                                                double& decrement) {
  using Set = ActiveSet<N>;
  typename Set::Weights direction = Set::Weights::Zero(set.size);
  for (int attempt = 0; attempt < 2; ++attempt) {
    std::array<int, Set::kCapacity> free;
    int m = 0;
    for (int i = 0; i < set.size; ++i)
      if (set.u[i] > 0.0 || (i == entering && attempt == 0)) free[m++] = i;
    typename Set::Lifteds zf(N, m);
    typename Set::Weights g(m);
    for (int a = 0; a < m; ++a) {
      zf.col(a) = z.col(free[a]);
      g[a] = kappa[free[a]] - N;
    }
    const typename Set::Hessian gram = zf.transpose() * zf;
    typename Set::Hessian h = gram.cwiseAbs2();
    // K o K has rank at most N (N + 1) / 2; the gradient lies in its range, so a small ridge is harmless.
    h.diagonal().array() += 1e-11 * h.diagonal().maxCoeff();
    const typename Set::Weights d = h.llt().solve(g);
    if (!d.allFinite()) break;
    decrement = std::sqrt(std::max(0.0, d.dot(g)));
    bool blocked = false;
    direction.setZero();
    for (int a = 0; a < m; ++a) {
      direction[free[a]] = d[a];
      blocked = blocked || (set.u[free[a]] == 0.0 && d[a] <= 0.0);
    }
    if (!blocked) break;
  }
  return direction;
}

/// Largest kappa / N - 1 with the weights normalised: the duality gap is at most N/2 times this.
template <int N>
double excess(const ActiveSet<N>& set, const typename ActiveSet<N>::Weights& kappa) {
  return kappa.maxCoeff() * set.u.head(set.size).sum() / N - 1.0;
}

/// Moves along `direction` as far as self-concordance and u >= 0 allow; a weight that reaches zero is zero.
template <int N>
void take_step(ActiveSet<N>& set, const typename ActiveSet<N>::Weights& direction, double decrement) {
  double length = decrement < 0.25 ? 1.0 : 1.0 / (1.0 + decrement);
  int blocking = -1;
  for (int i = 0; i < set.size; ++i)
    if (direction[i] < 0.0 && set.u[i] <= -length * direction[i]) {
      length = -set.u[i] / direction[i];
      blocking = i;
    }
  set.u.head(set.size) += length * direction;
  if (blocking >= 0) set.u[blocking] = 0.0;
  set.u.head(set.size) = set.u.head(set.size).cwiseMax(0.0);
}

/// One Wolfe-Atwood step: towards the worst point, or away from the least useful one. Always ascends.
template <int N>
void wolfe_atwood_step(ActiveSet<N>& set, const typename ActiveSet<N>::Weights& kappa) {
  int worst = 0, least = -1;
  for (int i = 0; i < set.size; ++i) {
    if (kappa[i] > kappa[worst]) worst = i;
    if (set.u[i] > 0.0 && (least < 0 || kappa[i] < kappa[least])) least = i;
  }
  const bool away = N - kappa[least] > kappa[worst] - N;
  const int i = away ? least : worst;
  double step = (kappa[i] - N) / (N * (kappa[i] - 1.0));
  if (away) step = std::max(step, -set.u[i] / (1.0 - set.u[i]));
  if (!std::isfinite(step)) return;
  set.u.head(set.size) *= 1.0 - step;
  set.u[i] = away && set.u[i] + step < 1e-15 ? 0.0 : set.u[i] + step;
}

/// Maximises the dual on the active set until its own excess is below `tolerance`; bounded work.
/// Returns the excess reached.
template <int N>
double maximise_dual(ActiveSet<N>& set, double tolerance) {
  using Set = ActiveSet<N>;
  constexpr int kNewtonSteps = 80, kFirstOrderSteps = 2000;
  typename Set::Lifteds z(N, set.size);
  typename Set::Weights kappa(set.size);
  double reached = 1e300;
  for (int step = 0; step < kNewtonSteps + kFirstOrderSteps; ++step) {
    set.normalise();
    if (!whitened(set, z)) return reached;
    kappa = z.colwise().squaredNorm().transpose();
    reached = excess(set, kappa);
    if (reached <= tolerance) break;
    if (step >= kNewtonSteps) {
      wolfe_atwood_step(set, kappa);
      continue;
    }
    if (reached > 0.5) {  // far away: cheap multiplicative steps before Newton pays
      set.u.head(set.size).array() *= kappa.array() / N;
      continue;
    }
    int entering = 0;
    for (int i = 1; i < set.size; ++i)
      if (kappa[i] > kappa[entering]) entering = i;
    double decrement = 0.0;
    const typename Set::Weights d = newton_direction(set, z, kappa, entering, decrement);
    take_step(set, d, decrement);
  }
  set.normalise();
  return reached;
}

}  // namespace bodice::fitting
