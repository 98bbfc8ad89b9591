// Based on: Kenneth Levenberg. 1944; Donald W. Marquardt. 1963 (damped Gauss-Newton).
// Differs: each residual depends on its nearest ellipsoid alone, so the normal matrix is block-diagonal, each
// block of 9 has its own damping and its own verdict; steps are bounded so that no ellipsoid overtakes the
// lists of who can be nearest; now and then ellipsoids are moved to where they gain more (relocation.hpp).
#include "tight_descent.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <bodice/engine/parallel.hpp>

#include "relocation.hpp"
#include "tight_step.hpp"

namespace bodice::fitting {
namespace {

using geometry::Ellipsoid;

constexpr int kRelocateEvery = 12;
constexpr int kIdleRounds = 3;  // after a search that found no move
constexpr int kStopWindow = 48;
constexpr double kExact = 2e-5;          // root of the mean square residual: nothing is left to gain
constexpr double kHeldBack = 0.9;        // of what it may move: an ellipsoid waits for other candidates
constexpr std::uint32_t kLeastSkin = 4;  // samples; with fewer an ellipsoid stands for nothing

struct State {
  std::vector<Ellipsoid> ellipsoids;
  std::vector<double> damping;
};

/// One descent under way.
class Descent {
 public:
  Descent(const engine::Context& context, TightProblem& problem, const std::vector<Ellipsoid>& ellipsoids,
          const DescentOptions& options)
      : context_(context),
        problem_(problem),
        options_(options),
        state_{ellipsoids, std::vector<double>(ellipsoids.size(), kFirstDamping)},
        moved_(ellipsoids.size(), 0.0) {
    refresh();
    best_ = state_;
    report_.first_cost = report_.last_cost = told_ = window_cost_ = problem_.total();
  }

  DescentReport run() {
    if (!options_.relocate) look_around();
    while (report_.iterations < options_.max_iterations &&
           !(options_.out_of_time && options_.out_of_time())) {
      context_.checkpoint();
      const int i = ++report_.iterations;
      iterate();
      note_best();
      if (i % kRelocateEvery == 0 && i < options_.max_iterations) {
        look_around();
        if (options_.relocate) make_moves();
      }
      if (is_done(i)) break;
    }
    problem_.refresh(context_, best_.ellipsoids);
    return report_;
  }

  const std::vector<Ellipsoid>& best() const { return best_.ellipsoids; }

 private:
  void refresh() {
    problem_.refresh(context_, state_.ellipsoids);
    std::fill(moved_.begin(), moved_.end(), 0.0);
  }

  /// One damped step of every ellipsoid; those that made it worse stay where they were.
  void iterate() {
    // One that waits costs more than a refresh: its neighbours settle around a place that it will leave.
    const double most = kHeldBack * problem_.most_motion();
    if (std::ranges::any_of(moved_, [&](double motion) { return motion > most; })) refresh();
    const auto blocks = problem_.normal_equations(context_, state_.ellipsoids);
    std::vector<TightStep> steps(blocks.size());
    engine::parallel_for(context_, steps.size(), 8, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k)
        steps[k] = damped_step(state_.ellipsoids[k], blocks[k], state_.damping[k],
                               problem_.most_motion() - moved_[k]);
    });
    problem_.remember();
    std::vector<Ellipsoid> trial;
    for (const TightStep& step : steps) trial.push_back(step.ellipsoid);
    problem_.evaluate(context_, trial);
    problem_.assign(context_);
    judge_steps(steps);
  }

  void judge_steps(const std::vector<TightStep>& steps) {
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
    if (!(cost < report_.last_cost)) return;
    report_.last_cost = cost;
    best_ = state_;
    if (!options_.on_improved || cost >= 0.95 * told_) return;
    told_ = cost;
    options_.on_improved(best_.ellipsoids);
  }

  /// More samples change what the cost is: the best so far is then the state that they were asked for.
  void look_around() {
    if (!options_.more_samples) return;
    const auto more = options_.more_samples(state_.ellipsoids);
    if (more.empty()) return;
    problem_.add(more);
    refresh();
    best_ = state_;
    report_.last_cost = problem_.total();
    window_cost_ = std::max(window_cost_, report_.last_cost);
  }

  /// Moves are tried with the rest fixed: what several do together may still be worse.
  void make_moves() {
    if (rounds_off_ > 0) return void(--rounds_off_);
    State moved = state_;
    const auto changed = relocate(context_, problem_, moved.ellipsoids);
    for (const std::size_t k : changed) moved.damping[k] = kFirstDamping;
    if (changed.empty()) return void(rounds_off_ = kIdleRounds);
    const double cost = problem_.total();
    std::swap(state_, moved);
    refresh();
    if (problem_.total() < cost) return note_best();
    state_ = std::move(moved);
    refresh();
  }

  bool is_done(int iteration) {
    const double exact = 0.5 * kExact * kExact * static_cast<double>(problem_.sample_count());
    if (report_.last_cost < exact) return report_.converged = true;
    if (iteration % kStopWindow != 0) return false;
    report_.converged = report_.last_cost > (1.0 - options_.least_gain) * window_cost_;
    window_cost_ = report_.last_cost;
    return report_.converged;
  }

  const engine::Context& context_;
  TightProblem& problem_;
  const DescentOptions& options_;
  State state_, best_;
  std::vector<double> moved_;  ///< #E: motion since the last refresh, at most
  int rounds_off_ = 0;
  DescentReport report_;
  double told_ = 0.0, window_cost_ = 0.0;
};

}  // namespace

DescentReport descend(const engine::Context& context, TightProblem& problem,
                      std::vector<Ellipsoid>& ellipsoids, const DescentOptions& options) {
  Descent descent(context, problem, ellipsoids, options);
  DescentReport report = descent.run();
  ellipsoids = descent.best();
  const auto held = problem.skin_of_each();
  for (std::size_t k = 0; k < held.size(); ++k)
    if (std::accumulate(held[k].begin(), held[k].end(), 0u) < kLeastSkin) report.idle.push_back(k);
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
