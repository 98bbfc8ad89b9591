// Based on: Kenneth Levenberg. 1944; Donald W. Marquardt. 1963 (damped Gauss-Newton).
// Differs: each residual depends on its nearest ellipsoid alone, so the normal matrix is block-diagonal, each
// block of 9 has its own damping and its own verdict; now and then the ellipsoid of least use is moved to
// where the cost is largest, and moved back unless that paid.
#include "tight_descent.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

namespace bodice::fitting {
namespace {

using geometry::Ellipsoid;

constexpr int kRefreshEvery = 8;    // candidate lists stay valid while ellipsoids move a few millimetres
constexpr int kRelocateEvery = 12;  // iterations that a move is given to prove itself
constexpr double kMaxShift = 0.02;  // of the scaled stature, an iteration
constexpr double kMaxLogRadius = 0.2;
constexpr double kMaxTurn_rad = 0.2;
constexpr double kMinRadius = 0.002;
constexpr double kStopGain = 0.002;  // of the cost, over kStopWindow iterations
constexpr int kStopWindow = 48;
constexpr std::size_t kLeastSkin = 4;  // samples; with fewer an ellipsoid stands for nothing

struct State {
  std::vector<Ellipsoid> ellipsoids;
  std::vector<double> damping;
};

Ellipsoid stepped(const Ellipsoid& e, const NormalBlock& block, double damping) {
  NormalBlock::Matrix a = block.jtj;
  const double typical = a.trace() / 9.0;
  for (int j = 0; j < 9; ++j) a(j, j) += damping * (a(j, j) + 0.005 * typical) + 1e-4 * typical + 1e-12;
  const NormalBlock::Vector step = -a.ldlt().solve(block.jtr);
  if (!step.allFinite()) return e;
  Ellipsoid next = e;
  next.center += step.head<3>().cwiseMax(-kMaxShift).cwiseMin(kMaxShift);
  for (int j = 0; j < 3; ++j)
    next.radii[j] =
        std::max(kMinRadius, e.radii[j] * std::exp(std::clamp(step[3 + j], -kMaxLogRadius, kMaxLogRadius)));
  Vec3 turn = step.tail<3>();
  const double angle = turn.norm();
  if (angle > 0.0)
    next.axes = e.axes * Eigen::AngleAxisd(std::min(angle, kMaxTurn_rad), turn / angle).toRotationMatrix();
  return next;
}

/// One damped step of every ellipsoid; those that made it worse stay where they were.
void iterate(const engine::Context& context, TightProblem& problem, State& state) {
  const auto blocks = problem.normal_equations(context, state.ellipsoids);
  problem.remember();
  std::vector<Ellipsoid> trial = state.ellipsoids;
  for (std::size_t k = 0; k < trial.size(); ++k) trial[k] = stepped(trial[k], blocks[k], state.damping[k]);
  problem.evaluate(context, trial);
  problem.assign(context);
  const std::vector<double> gain = problem.gains();
  bool restored = false;
  for (std::size_t k = 0; k < trial.size(); ++k) {
    if (gain[k] >= 0.0) {
      state.ellipsoids[k] = trial[k];
      state.damping[k] = std::max(1e-6, 0.4 * state.damping[k]);
    } else {
      problem.restore(k);
      state.damping[k] = std::min(1e6, 5.0 * state.damping[k]);
      restored = true;
    }
  }
  if (restored) problem.assign(context);
}

/// Moves up to `moves` of the least useful ellipsoids onto halves of the costliest ones.
void relocate(const TightProblem& problem, State& state, int moves) {
  const std::vector<double> cost = problem.cost_of_each(), use = problem.use_of_each();
  std::vector<std::size_t> by_cost(cost.size()), by_use(use.size());
  std::iota(by_cost.begin(), by_cost.end(), std::size_t{0});
  by_use = by_cost;
  std::stable_sort(by_cost.begin(), by_cost.end(), [&](auto a, auto b) { return cost[a] > cost[b]; });
  std::stable_sort(by_use.begin(), by_use.end(), [&](auto a, auto b) { return use[a] < use[b]; });
  std::vector<bool> taken(cost.size(), false);
  std::size_t next_use = 0;
  for (std::size_t i = 0; i < by_cost.size() && moves > 0; ++i) {
    const std::size_t worst = by_cost[i];
    if (taken[worst]) continue;
    while (next_use < by_use.size() && (taken[by_use[next_use]] || by_use[next_use] == worst)) ++next_use;
    if (next_use == by_use.size() || use[by_use[next_use]] > 0.5 * cost[worst]) return;
    const std::size_t idle = by_use[next_use];
    taken[worst] = taken[idle] = true;
    int longest = 0;
    Ellipsoid& e = state.ellipsoids[worst];
    e.radii.maxCoeff(&longest);
    const Vec3 half = 0.5 * e.radii[longest] * e.axes.col(longest);
    e.radii[longest] *= 0.6;
    Ellipsoid twin = e;
    e.center += half;
    twin.center -= half;
    state.ellipsoids[idle] = twin;
    state.damping[worst] = state.damping[idle] = 1e-2;
    --moves;
  }
}

}  // namespace

DescentReport descend(const engine::Context& context, TightProblem& problem,
                      std::vector<Ellipsoid>& ellipsoids, const DescentOptions& options) {
  State state{ellipsoids, std::vector<double>(ellipsoids.size(), 1e-2)};
  problem.refresh(context, state.ellipsoids);
  DescentReport report{0, problem.total(), problem.total(), {}, false};
  State best = state, before_move = state;
  double told = report.first_cost, cost_before_move = -1.0, window_cost = report.first_cost;
  int moves = std::max(1, static_cast<int>(ellipsoids.size()) / 12);
  while (report.iterations < options.max_iterations && !(options.out_of_time && options.out_of_time())) {
    context.checkpoint();
    const int i = ++report.iterations;
    iterate(context, problem, state);
    if (i % kRefreshEvery == 0) problem.refresh(context, state.ellipsoids);
    const double cost = problem.total();
    if (cost < report.last_cost) {
      report.last_cost = cost;
      best = state;
      if (options.on_improved && cost < 0.95 * told) {
        told = cost;
        options.on_improved(best.ellipsoids);
      }
    }
    if (i % kRelocateEvery == 0) {
      if (cost_before_move >= 0.0 && cost > cost_before_move) {
        state = before_move;
        problem.refresh(context, state.ellipsoids);
        moves = std::max(1, moves / 2);
      }
      before_move = state;
      cost_before_move = problem.total();
      relocate(problem, state, moves);
      problem.refresh(context, state.ellipsoids);
    }
    if (i % kStopWindow == 0) {
      if (report.last_cost > (1.0 - kStopGain) * window_cost) {
        report.converged = true;
        break;
      }
      window_cost = report.last_cost;
    }
  }
  problem.refresh(context, best.ellipsoids);
  const std::vector<std::size_t> held = problem.skin_of_each();
  ellipsoids = best.ellipsoids;
  for (std::size_t k = 0; k < held.size(); ++k)
    if (held[k] < kLeastSkin) report.idle.push_back(k);
  return report;
}

void take_parts(const TightProblem& problem, std::span<const DistanceSample> samples,
                std::vector<proxy::ProxyEllipsoid>& ellipsoids) {
  std::vector<std::array<int, body::kPartCount>> votes(ellipsoids.size());
  const std::vector<std::uint32_t> owner = problem.skin_owner();
  for (std::size_t i = 0; i < owner.size(); ++i)
    if (owner[i] != TightProblem::kNoOwner) ++votes[owner[i]][static_cast<int>(samples[i].part)];
  for (std::size_t k = 0; k < ellipsoids.size(); ++k) {
    const auto most = std::max_element(votes[k].begin(), votes[k].end());
    if (*most > 0) ellipsoids[k].part = static_cast<body::Part>(most - votes[k].begin());
  }
}

}  // namespace bodice::fitting
