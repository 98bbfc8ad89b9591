// Based on: Michael J. Todd, E. Alper Yildirim. On Khachiyan's algorithm for the computation of
// minimum-volume enclosing ellipsoids. 2007. - section 4 (steps toward the worst point and away from the
// least useful one).
// Differs: it works in the rank-revealing frame, so that flat sets are solved in their own dimension. M^-1 is
// computed anew from the weights every 50 steps, so that rounding of the rank-one updates cannot accumulate.
#include <bodice/fitting/mvee.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/LU>

#include "mvee/mvee_finish.hpp"
#include "mvee/point_frame.hpp"

namespace bodice::inline v0_1::fitting {
namespace {

/// The weights of all points in the course of the iteration.
template <int R>
struct Khachiyan {
  static constexpr int N = R + 1;
  using Lifted = Eigen::Matrix<double, N, 1>;
  using Square = Eigen::Matrix<double, N, N>;

  const PointFrame& frame;
  std::vector<double> u, kappa;
  Square inverse = Square::Identity();

  explicit Khachiyan(const PointFrame& f) : frame(f), u(f.kept.size()), kappa(f.kept.size()) {
    // A few extreme points are a far better start than all points, unless they do not span the set.
    for (int axis = 0; axis < R; ++axis) {
      const auto [low, high] = std::minmax_element(frame.y[axis].begin(), frame.y[axis].end());
      u[static_cast<std::size_t>(low - frame.y[axis].begin())] += 1.0;
      u[static_cast<std::size_t>(high - frame.y[axis].begin())] += 1.0;
    }
    Square moment = Square::Zero();
    for (std::size_t i = 0; i < u.size(); ++i)
      if (u[i] > 0.0) moment += u[i] * point(i) * point(i).transpose();
    if (!(moment.determinant() > 1e-6)) std::fill(u.begin(), u.end(), 1.0);
  }

  Lifted point(std::size_t i) const {
    Lifted q;
    for (int j = 0; j < R; ++j) q[j] = frame.y[j][i];
    q[R] = 1.0;
    return q;
  }

  void refresh() {
    double total = 0.0;
    for (const double w : u) total += w;
    Square moment = Square::Zero();
    for (std::size_t i = 0; i < u.size(); ++i) {
      u[i] /= total;
      if (u[i] > 0.0) moment += u[i] * point(i) * point(i).transpose();
    }
    inverse = moment.inverse();
    for (std::size_t i = 0; i < u.size(); ++i) kappa[i] = point(i).dot(inverse * point(i));
  }

  /// u <- (1 - step) u + step e_i, with kappa by the Sherman-Morrison formula.
  void move(std::size_t i, double step) {
    const Lifted v = inverse * point(i);
    const double k = kappa[i], shrink = 1.0 - step;
    const double factor = step / (shrink + step * k);
    for (std::size_t j = 0; j < u.size(); ++j) {
      const double along = v.dot(point(j));
      kappa[j] = (kappa[j] - factor * along * along) / shrink;
      u[j] *= shrink;
    }
    inverse = (inverse - factor * v * v.transpose()) / shrink;
    u[i] += step;
  }

  /// Runs until the certified gap is below epsilon; returns the steps taken.
  int run(double epsilon) {
    constexpr int kMaxSteps = 10000;
    const double tolerance = 2.0 * epsilon / N;
    for (int step = 0; step < kMaxSteps; ++step) {
      if (step % 50 == 0) refresh();
      std::size_t worst = 0, least = u.size();
      for (std::size_t i = 0; i < u.size(); ++i) {
        if (kappa[i] > kappa[worst]) worst = i;
        if (u[i] > 0.0 && (least == u.size() || kappa[i] < kappa[least])) least = i;
      }
      const double above = kappa[worst] / N - 1.0, below = 1.0 - kappa[least] / N;
      if (above <= tolerance) return step;
      const bool away = below > above && u[least] < 1.0;
      const std::size_t i = away ? least : worst;
      double length = (kappa[i] - N) / (N * (kappa[i] - 1.0));
      const bool drops = away && -length >= u[i] / (1.0 - u[i]);
      if (drops || (away && kappa[i] <= 1.0)) length = -u[i] / (1.0 - u[i]);
      move(i, length);
      if (drops) u[i] = 0.0;
    }
    return kMaxSteps;
  }
};

template <int R>
Mvee solve(const PointFrame& frame, double epsilon, double min_radius_m) {
  Khachiyan<R> state(frame);
  Mvee result;
  result.rounds = state.run(epsilon) + 1;
  state.refresh();
  std::vector<std::size_t> support;
  for (std::size_t i = 0; i < state.u.size(); ++i)
    if (state.u[i] > 0.0) support.push_back(i);
  Eigen::Matrix<double, R, Eigen::Dynamic> points(R, support.size());
  Eigen::VectorXd weights(support.size());
  for (std::size_t k = 0; k < support.size(); ++k) {
    points.col(static_cast<Eigen::Index>(k)) = state.point(support[k]).template head<R>();
    weights[static_cast<Eigen::Index>(k)] = state.u[support[k]];
  }
  finish<R>(frame, points, weights, min_radius_m, result);
  return result;
}

}  // namespace

Mvee mvee_first_order(std::span<const Vec3> points, double epsilon, double min_radius_m) {
  const PointFrame frame = make_point_frame(points, kFlatRelative);
  Mvee result;
  switch (frame.rank) {
    case 3:
      result = solve<3>(frame, epsilon, min_radius_m);
      break;
    case 2:
      result = solve<2>(frame, epsilon, min_radius_m);
      break;
    default:
      result = finish_thin(frame, min_radius_m);
      break;
  }
  result.skipped = points.size() - frame.kept.size();
  return result;
}

}  // namespace bodice::fitting
