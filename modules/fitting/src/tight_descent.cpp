// Based on: Kenneth Levenberg. 1944; Donald W. Marquardt. 1963 (damped Gauss-Newton).
// Differs: each residual depends on its nearest ellipsoid alone, so the normal matrix is block-diagonal, each
// block of 9 has its own damping and its own verdict; steps are bounded so that no ellipsoid overtakes the
// lists of who can be nearest; now and then the ellipsoids of least use are moved to where the cost is
// largest (relocation.hpp), and moved back unless that paid.
#include "tight_descent.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include <bodice/engine/parallel.hpp>

#include "relocation.hpp"

namespace bodice::fitting {
namespace {

using geometry::Ellipsoid;

constexpr int kRelocateEvery = 12;  // iterations that a move is given to prove itself
constexpr double kMinRadius = 0.002;
constexpr double kFirstDamping = 1e-2;
constexpr int kStopWindow = 48;
constexpr double kMostHeldBack = 0.1;    // steps an ellipsoid, before the candidates are chosen afresh
constexpr std::uint32_t kLeastSkin = 4;  // samples; with fewer an ellipsoid stands for nothing

struct State {
  std::vector<Ellipsoid> ellipsoids;
  std::vector<double> damping;
};

struct Step {
  Ellipsoid ellipsoid;
  double motion = 0.0;  ///< no point of the surface moves farther
};

/// A damped step, shortened to `most_motion`.
Step stepped(const Ellipsoid& e, const NormalBlock& block, double damping, double most_motion) {
  NormalBlock::Matrix a = block.jtj;
  const double typical = a.trace() / 9.0;
  for (int j = 0; j < 9; ++j) a(j, j) += damping * (a(j, j) + 0.005 * typical) + 1e-4 * typical + 1e-12;
  NormalBlock::Vector step = -a.ldlt().solve(block.jtr);
  if (!step.allFinite()) return {e};
  const Vec3 stretch = e.radii.cwiseProduct(step.segment<3>(3));
  const double motion =
      step.head<3>().norm() + stretch.cwiseAbs().maxCoeff() + e.radii.maxCoeff() * step.tail<3>().norm();
  if (motion > most_motion) step *= most_motion / motion;
  Ellipsoid next = e;
  next.center += step.head<3>();
  next.radii = (e.radii.array() * (1.0 + step.segment<3>(3).array().max(-0.5))).max(kMinRadius);
  const Vec3 turn = step.tail<3>();
  const double angle = turn.norm();
  if (angle > 0.0) next.axes = e.axes * Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix();
  return {next, std::min(motion, most_motion)};
}

class Descent {
 public:
  Descent(const engine::Context& context, TightProblem& problem, const std::vector<Ellipsoid>& ellipsoids)
      : context_(context),
        problem_(problem),
        state_{ellipsoids, std::vector<double>(ellipsoids.size(), kFirstDamping)},
        moved_(ellipsoids.size(), 0.0) {
    refresh();
  }

  const State& state() const { return state_; }

  void refresh() {
    problem_.refresh(context_, state_.ellipsoids);
    std::fill(moved_.begin(), moved_.end(), 0.0);
    held_back_ = 0;
  }

  void reset(State state) {
    state_ = std::move(state);
    refresh();
  }

  /// One damped step of every ellipsoid; those that made it worse stay where they were.
  void iterate() {
    if (static_cast<double>(held_back_) > kMostHeldBack * static_cast<double>(moved_.size())) refresh();
    const auto blocks = problem_.normal_equations(context_, state_.ellipsoids);
    std::vector<Step> steps(blocks.size());
    engine::parallel_for(context_, steps.size(), 8, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k)
        steps[k] =
            stepped(state_.ellipsoids[k], blocks[k], state_.damping[k], problem_.most_motion() - moved_[k]);
    });
    problem_.remember();
    std::vector<Ellipsoid> trial;
    for (const Step& step : steps) trial.push_back(step.ellipsoid);
    problem_.evaluate(context_, trial);
    problem_.assign(context_);
    judge(steps);
  }

 private:
  void judge(const std::vector<Step>& steps) {
    const std::vector<double> gain = problem_.gains();
    bool restored = false;
    for (std::size_t k = 0; k < steps.size(); ++k) {
      if (gain[k] >= 0.0) {
        state_.ellipsoids[k] = steps[k].ellipsoid;
        state_.damping[k] = std::max(1e-6, 0.4 * state_.damping[k]);
        moved_[k] += steps[k].motion;
        held_back_ += moved_[k] > 0.9 * problem_.most_motion();
      } else {
        problem_.restore(k);
        state_.damping[k] = std::min(1e6, 5.0 * state_.damping[k]);
        restored = true;
      }
    }
    if (restored) problem_.assign(context_);
  }

  const engine::Context& context_;
  TightProblem& problem_;
  State state_;
  std::vector<double> moved_;  ///< #E: motion since the last refresh, at most
  std::size_t held_back_ = 0;  ///< steps that used up what an ellipsoid may move before a refresh
};

}  // namespace

DescentReport descend(const engine::Context& context, TightProblem& problem,
                      std::vector<Ellipsoid>& ellipsoids, const DescentOptions& options) {
  Descent descent(context, problem, ellipsoids);
  DescentReport report{0, problem.total(), problem.total(), {}, false};
  State best = descent.state(), before_move = best;
  double told = report.first_cost, cost_before_move = -1.0, window_cost = report.first_cost;
  Relocation relocation(ellipsoids.size());
  while (report.iterations < options.max_iterations && !(options.out_of_time && options.out_of_time())) {
    context.checkpoint();
    const int i = ++report.iterations;
    descent.iterate();
    if (i % kRelocateEvery == 0) {
      descent.refresh();
      if (cost_before_move >= 0.0) {
        const bool paid = problem.total() < cost_before_move;
        relocation.judge(paid);
        if (!paid) descent.reset(before_move);
      }
    }
    const double cost = problem.total();
    if (cost < report.last_cost) {
      report.last_cost = cost;
      best = descent.state();
      if (options.on_improved && cost < 0.95 * told) {
        told = cost;
        options.on_improved(best.ellipsoids);
      }
    }
    if (i % kRelocateEvery == 0) {
      if (options.more_samples) {
        const auto more = options.more_samples(descent.state().ellipsoids);
        if (!more.empty()) {
          problem.add(more);
          descent.refresh();
          best = descent.state();
          report.last_cost = problem.total();
          window_cost = std::max(window_cost, report.last_cost);
        }
      }
      before_move = descent.state();
      cost_before_move = problem.total();
      State moved = before_move;
      for (const std::size_t k : relocation.move(problem, moved.ellipsoids)) moved.damping[k] = kFirstDamping;
      descent.reset(std::move(moved));
    }
    if (i % kStopWindow == 0) {
      if (report.last_cost > (1.0 - options.least_gain) * window_cost) {
        report.converged = true;
        break;
      }
      window_cost = report.last_cost;
    }
  }
  problem.refresh(context, best.ellipsoids);
  ellipsoids = best.ellipsoids;
  const auto held = problem.skin_of_each();
  for (std::size_t k = 0; k < held.size(); ++k) {
    std::uint32_t skin = 0;
    for (const std::uint32_t n : held[k]) skin += n;
    if (skin < kLeastSkin) report.idle.push_back(k);
  }
  return report;
}

void take_parts(const TightProblem& problem, std::vector<proxy::ProxyEllipsoid>& ellipsoids) {
  const auto votes = problem.skin_of_each();
  for (std::size_t k = 0; k < ellipsoids.size(); ++k) {
    const auto most = std::max_element(votes[k].begin(), votes[k].end());
    if (*most > 0) ellipsoids[k].part = static_cast<body::Part>(most - votes[k].begin());
  }
}

}  // namespace bodice::fitting
