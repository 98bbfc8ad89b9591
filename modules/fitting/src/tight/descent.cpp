// Based on: Kenneth Levenberg. 1944; Donald W. Marquardt. 1963 (damped Gauss-Newton).
// Differs: each residual depends on its nearest ellipsoid alone, so the normal matrix is block-diagonal, each
// block of 9 has its own damping and its own verdict; steps are bounded so that no ellipsoid overtakes the
// lists of who can be nearest; now and then ellipsoids are moved to where they gain more (relocation.hpp).
#include "tight/descent.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <bodice/engine/parallel.hpp>

#include "tight/split_and_merge.hpp"

namespace bodice::fitting {
namespace {

using geometry::Ellipsoid;

constexpr int kRelocateEvery = 8;
constexpr int kIdleRounds = 3;           // after a search that found no move
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
    ask_for_samples();
    refresh();
    best_ = state_;
    is_best_ = true;
    best_cost_ = told_ = problem_.total();
  }

  void run() {
    for (int i = 1; i <= options_.iterations && !is_exact() && !is_out_of_time(); ++i) {
      context_.checkpoint();
      iterate();
      note_best();
      if (options_.relocate && i % kRelocateEvery == 0 && i < options_.iterations) {
        look_around();
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

  /// One damped step of every ellipsoid; those that made it worse stay where they were.
  void iterate() {
    // One that waits costs more than a refresh: its neighbors settle around a place that it will leave.
    const double most = kHeldBack * problem_.most_motion();
    if (std::ranges::any_of(moved_, [&](double motion) { return motion > most; })) refresh();
    const auto blocks = problem_.normal_equations(context_, state_.ellipsoids);
    std::vector<TightStep> steps(blocks.size());
    engine::parallel_for(context_, steps.size(), 8, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k)
        steps[k] = damped_step(state_.ellipsoids[k], blocks[k], state_.damping[k],
                               problem_.most_motion() - moved_[k], options_.over_step);
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
    is_best_ = cost < best_cost_;
    if (!is_best_) return;
    best_cost_ = cost;
    best_ = state_;
    if (!options_.on_improved || cost >= 0.95 * told_) return;
    told_ = cost;
    options_.on_improved(best_.ellipsoids);
  }

  bool ask_for_samples() {
    if (!options_.more_samples) return false;
    const auto more = options_.more_samples(state_.ellipsoids);
    if (!more.empty()) problem_.add(more);
    return !more.empty();
  }

  /// More samples change what the cost is: the best so far is then the state that they were asked for.
  void look_around() {
    if (!ask_for_samples()) return;
    refresh();
    best_ = state_;
    is_best_ = true;
    best_cost_ = problem_.total();
  }

  /// Moves are tried with the rest fixed: what several do together may still be worse.
  void make_moves() {
    if (rounds_off_ > 0) return void(--rounds_off_);
    State moved = state_;
    const auto changed = relocate(context_, problem_, moved.ellipsoids);
    for (const std::size_t k : changed) moved.damping[k] = kFirstDamping;
    if (changed.empty()) return void(rounds_off_ = kIdleRounds);
    const double cost = problem_.total();
    TightProblem kept = problem_;
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
  TightProblem& problem_;
  const DescentOptions& options_;
  State state_, best_;
  std::vector<double> moved_;  ///< #E: motion since the last refresh, at most
  bool is_best_ = true;        ///< state_ is best_
  int rounds_off_ = 0;
  double best_cost_ = 0.0, told_ = 0.0;
};

}  // namespace

std::vector<std::size_t> descend(const engine::Context& context, TightProblem& problem,
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

void take_parts(const TightProblem& problem, std::vector<proxy::ProxyEllipsoid>& ellipsoids) {
  const auto votes = problem.skin_of_each();
  for (std::size_t k = 0; k < ellipsoids.size(); ++k) {
    const auto most = std::max_element(votes[k].begin(), votes[k].end());
    if (*most > 0) ellipsoids[k].part = static_cast<body::Part>(most - votes[k].begin());
  }
}

}  // namespace bodice::fitting
