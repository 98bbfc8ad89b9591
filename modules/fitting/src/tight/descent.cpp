// Based on: Kenneth Levenberg. A Method for the Solution of Certain Non-Linear Problems in Least Squares.
// 1944. Based on: Donald W. Marquardt. An Algorithm for Least-Squares Estimation of Nonlinear Parameters.
// 1963. Differs: each residual depends on its nearest ellipsoid alone, so that the normal matrix is
// block-diagonal. Each block of 9 unknowns has its own damping, and its step is kept or undone on its own.
// Steps are bounded so that lists of candidates stay valid. Every few steps, split-and-merge moves are tried
// (split_and_merge.hpp).
#include "tight/descent.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <bodice/engine/parallel.hpp>

#include "tight/split_and_merge.hpp"

namespace bodice::inline v0_1::fitting {
namespace {

using geometry::Ellipsoid;

constexpr int kMovesEvery = 8;     // split-and-merge moves are tried once in so many steps
constexpr int kIdleRounds = 3;     // rounds without moves after one that found none
constexpr double kExact = 2e-5;    // root mean square residual at which nothing is left to gain
constexpr double kHeldBack = 0.9;  // fraction of the allowed motion after which candidates are chosen afresh
constexpr std::uint32_t kLeastSkin = 4;  // samples; an ellipsoid with fewer of them holds no skin

/// All ellipsoids with their damping.
struct DescentState {
  std::vector<Ellipsoid> ellipsoids;
  std::vector<double> damping;
};

/// A descent in progress.
class Descent {
 public:
  Descent(const engine::Context& context, LeastSquaresProblem& problem,
          const std::vector<Ellipsoid>& ellipsoids, const DescentOptions& options)
      : context_(context),
        problem_(problem),
        options_(options),
        state_{ellipsoids, std::vector<double>(ellipsoids.size(), kFirstDamping)},
        moved_(ellipsoids.size(), 0.0) {
    add_samples();
    refresh();
    best_ = state_;
    is_best_ = true;
    best_cost_ = published_cost_ = problem_.total();
  }

  void run() {
    for (int i = 1; i <= options_.iterations && !is_exact() && !is_out_of_time(); ++i) {
      context_.checkpoint();
      iterate();
      note_best();
      if (options_.split_and_merge && i % kMovesEvery == 0 && i < options_.iterations) {
        extend_samples();
        make_moves();
      }
    }
    if (!is_best_) problem_.refresh(context_, best_.ellipsoids);
  }

  const std::vector<Ellipsoid>& best() const { return best_.ellipsoids; }

 private:
  void refresh() {
    problem_.refresh(context_, state_.ellipsoids);
    std::fill(moved_.begin(), moved_.end(), 0.0);
  }

  /// Takes one damped step of every ellipsoid; steps that raised the cost are undone.
  void iterate() {
    // An ellipsoid that is held back costs more than a refresh: its neighbors settle around a position that
    // it leaves.
    const double most = kHeldBack * problem_.most_motion();
    if (std::ranges::any_of(moved_, [&](double motion) { return motion > most; })) refresh();
    const auto blocks = problem_.normal_equations(context_, state_.ellipsoids);
    std::vector<DampedStep> steps(blocks.size());
    engine::parallel_for(context_, steps.size(), 8, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k)
        steps[k] = damped_step(state_.ellipsoids[k], blocks[k], state_.damping[k],
                               problem_.most_motion() - moved_[k], options_.over_step);
    });
    problem_.remember();
    std::vector<Ellipsoid> trial;
    for (const DampedStep& step : steps) trial.push_back(step.ellipsoid);
    problem_.evaluate(context_, trial);
    problem_.assign(context_);
    judge_steps(steps);
  }

  void judge_steps(const std::vector<DampedStep>& steps) {
    const std::vector<double> gain = problem_.gains();
    bool restored = false;
    for (std::size_t k = 0; k < steps.size(); ++k) {
      if (gain[k] >= 0.0) {
        state_.ellipsoids[k] = steps[k].ellipsoid;
        state_.damping[k] = std::max(1e-6, 0.4 * state_.damping[k]);
        moved_[k] += steps[k].motion;
      } else {
        problem_.restore(k);
        state_.damping[k] = std::min(1e6, 2.0 * state_.damping[k]);
        restored = true;
      }
    }
    if (restored) problem_.assign(context_);
  }

  void note_best() {
    const double cost = problem_.total();
    is_best_ = cost < best_cost_;
    if (!is_best_) return;
    best_cost_ = cost;
    best_ = state_;
    if (!options_.on_improved || cost >= 0.95 * published_cost_) return;
    published_cost_ = cost;
    options_.on_improved(best_.ellipsoids);
  }

  /// Adds the samples that the state needs; false if there are none.
  bool add_samples() {
    if (!options_.more_samples) return false;
    const auto more = options_.more_samples(state_.ellipsoids);
    if (!more.empty()) problem_.add(more);
    return !more.empty();
  }

  /// Adds samples. They change the cost, so that the best state so far becomes the one that they were found
  /// for.
  void extend_samples() {
    if (!add_samples()) return;
    refresh();
    best_ = state_;
    is_best_ = true;
    best_cost_ = problem_.total();
  }

  /// Makes split-and-merge moves and undoes them if the cost rose: each was tried with all others fixed, so
  /// that several together may be worse.
  void make_moves() {
    if (rounds_off_ > 0) return void(--rounds_off_);
    DescentState moved = state_;
    const auto changed = fitting::split_and_merge(context_, problem_, moved.ellipsoids);
    for (const std::size_t k : changed) moved.damping[k] = kFirstDamping;
    if (changed.empty()) return void(rounds_off_ = kIdleRounds);
    const double cost = problem_.total();
    LeastSquaresProblem kept = problem_;
    const std::vector<double> kept_motion = moved_;
    std::swap(state_, moved);
    refresh();
    if (problem_.total() < cost) return note_best();
    state_ = std::move(moved);
    problem_ = std::move(kept);
    moved_ = kept_motion;
  }

  bool is_exact() const {
    return best_cost_ < 0.5 * kExact * kExact * static_cast<double>(problem_.sample_count());
  }
  bool is_out_of_time() const { return options_.out_of_time && options_.out_of_time(); }

  const engine::Context& context_;
  LeastSquaresProblem& problem_;
  const DescentOptions& options_;
  DescentState state_, best_;
  std::vector<double> moved_;  ///< #E: bound on the motion since the last refresh
  bool is_best_ = true;        ///< whether state_ is best_
  int rounds_off_ = 0;         ///< rounds left without moves
  double best_cost_ = 0.0, published_cost_ = 0.0;
};

}  // namespace

std::vector<std::size_t> descend(const engine::Context& context, LeastSquaresProblem& problem,
                                 std::vector<Ellipsoid>& ellipsoids, const DescentOptions& options) {
  Descent descent(context, problem, ellipsoids, options);
  descent.run();
  ellipsoids = descent.best();
  const auto held = problem.skin_of_each();
  std::vector<std::size_t> idle;
  for (std::size_t k = 0; k < held.size(); ++k)
    if (std::accumulate(held[k].begin(), held[k].end(), 0u) < kLeastSkin) idle.push_back(k);
  return idle;
}

void take_parts(const LeastSquaresProblem& problem, std::vector<proxy::ProxyEllipsoid>& ellipsoids) {
  const auto votes = problem.skin_of_each();
  for (std::size_t k = 0; k < ellipsoids.size(); ++k) {
    const auto most = std::max_element(votes[k].begin(), votes[k].end());
    if (*most > 0) ellipsoids[k].part = static_cast<body::Part>(most - votes[k].begin());
  }
}

}  // namespace bodice::fitting
