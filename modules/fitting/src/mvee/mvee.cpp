// Based on: Piyush Kumar, E. Alper Yildirim. Minimum-Volume Enclosing Ellipsoids and Core Sets. 2005.
// Differs: the core set starts from 14 directional extremes, grows by the worst point of each octant, sheds
// idle points, and is solved by a damped Newton method (mvee_dual.hpp), so a handful of scans reaches 1e-7.
#include <bodice/fitting/mvee.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "mvee/dual_levels.hpp"
#include "mvee/mvee_dual.hpp"
#include "mvee/mvee_finish.hpp"
#include "mvee/point_frame.hpp"

namespace bodice::inline v0_1::fitting {
namespace {

template <int R>
Eigen::Matrix<double, R + 1, 1> lifted(const PointFrame& frame, std::size_t i) {
  Eigen::Matrix<double, R + 1, 1> q;
  for (int j = 0; j < R; ++j) q[j] = frame.y[j][i];
  q[R] = 1.0;
  return q;
}

/// Adds the points farthest along the axes and the diagonals, and the point that the frame was grown from.
/// That point and the farthest ones along each axis span the set, so that M is positive definite from the
/// start.
template <int R>
void add_extremes(const PointFrame& frame, ActiveSet<R + 1>& set) {
  constexpr int kDiagonals = 1 << (R - 1), kDirections = R + kDiagonals;
  std::array<std::size_t, 2 * kDirections + 1> chosen{};
  const std::size_t n = frame.kept.size();
  std::array<double, kDirections> low, high;
  low.fill(1e300), high.fill(-1e300);
  for (std::size_t i = 0; i < n; ++i) {
    std::array<double, kDirections> along;
    for (int j = 0; j < R; ++j) along[j] = frame.y[j][i];
    for (int d = 0; d < kDiagonals; ++d) {
      along[R + d] = along[0];
      for (int j = 1; j < R; ++j) along[R + d] += (d >> (j - 1)) & 1 ? along[j] : -along[j];
    }
    for (int k = 0; k < kDirections; ++k) {
      if (along[k] < low[k]) low[k] = along[k], chosen[2 * k] = i;
      if (along[k] > high[k]) high[k] = along[k], chosen[2 * k + 1] = i;
    }
  }
  std::sort(chosen.begin(), chosen.end());
  const auto end = std::unique(chosen.begin(), chosen.end());
  for (auto i = chosen.begin(); i != end; ++i) set.add(lifted<R>(frame, *i), 1.0);
}

/// Finds kappa = |map q|^2 of every point; `map` is (R + 1) x (R + 1).
template <int R, class Map>
void find_kappas(const PointFrame& frame, const Map& map, std::vector<double>& kappa) {
  LiftedMap lifted;
  for (int r = 0; r <= R; ++r) {
    for (int j = 0; j < R; ++j) lifted.row[r][j] = map(r, j);
    lifted.row[r][3] = map(r, R);
  }
  kappa.resize(frame.kept.size());
  dual_levels(lifted, kappa.size(), frame.y[0].data(), frame.y[1].data(), frame.y[2].data(), kappa.data());
}

/// Adds the point with the largest kappa of each orthant, if it exceeds N; returns the largest kappa / N - 1
/// over all points.
template <int R>
double scan(const PointFrame& frame, ActiveSet<R + 1>& set, double tolerance, std::vector<double>& kappa) {
  using Set = ActiveSet<R + 1>;
  const Eigen::LLT<typename Set::Square> llt(set.moment());
  if (llt.info() != Eigen::Success) return 1e300;
  const typename Set::Square inverse = llt.matrixL().solve(Set::Square::Identity());
  find_kappas<R>(frame, inverse, kappa);
  std::array<double, 1 << R> worst;
  worst.fill((1.0 + tolerance) * (R + 1));
  std::array<std::size_t, 1 << R> at{};
  std::array<bool, 1 << R> found{};
  double largest = 0.0;
  for (std::size_t i = 0; i < kappa.size(); ++i) {
    largest = std::max(largest, kappa[i]);
    if (!(kappa[i] > (1.0 + tolerance) * (R + 1))) continue;
    const typename Set::Lifted z = inverse * lifted<R>(frame, i);
    int orthant = 0;
    for (int j = 0; j < R; ++j) orthant |= (z[R - 1 - j] > 0.0) << j;
    if (kappa[i] > worst[orthant]) worst[orthant] = kappa[i], at[orthant] = i, found[orthant] = true;
  }
  for (int k = 0; k < (1 << R); ++k)
    if (found[k] && !set.full()) set.add(lifted<R>(frame, at[k]), 0.0);
  return largest / (R + 1) - 1.0;
}

template <int R>
Mvee solve(const PointFrame& frame, const MveeOptions& options) {
  constexpr int kMaxRounds = 100;
  // The gap is at most N/2 times the excess; half of the tolerance is left to the scan over all points.
  const double tolerance = std::max(options.volume_tolerance, 1e-13) * 2.0 / (R + 1);
  ActiveSet<R + 1> set;
  add_extremes<R>(frame, set);
  Mvee result;
  double excess_all = 0.0;
  std::vector<double> kappa;
  while (result.rounds < kMaxRounds) {
    maximize_dual(set, 0.5 * tolerance);
    set.drop_idle();
    ++result.rounds;
    excess_all = scan<R>(frame, set, 0.5 * tolerance, kappa);
    if (excess_all <= tolerance) break;
  }
  set.drop_idle();
  finish<R>(frame, set.q.leftCols(set.size).template topRows<R>(),
            Eigen::Map<const Eigen::VectorXd>(set.u.data(), set.size), options.min_radius_m, result);
  return result;
}

}  // namespace

Mvee mvee(std::span<const Vec3> points, const MveeOptions& options) {
  const PointFrame frame = make_point_frame(points, kFlatRelative);
  Mvee result;
  switch (frame.rank) {
    case 3:
      result = solve<3>(frame, options);
      break;
    case 2:
      result = solve<2>(frame, options);
      break;
    default:
      result = finish_thin(frame, options.min_radius_m);
      break;
  }
  result.skipped = points.size() - frame.kept.size();
  return result;
}

}  // namespace bodice::fitting
