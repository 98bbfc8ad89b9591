#include "simulate.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <functional>
#include <limits>
#include <queue>
#include <tuple>
#include <utility>

#include <bodice/engine/random.hpp>

namespace cluster {
namespace {

using Task = std::vector<std::uint32_t>;  // jobs that have no result yet
constexpr double kNever = std::numeric_limits<double>::infinity();

/// A node that becomes free, or a task that becomes available.
struct Event {
  double time_s = 0.0;
  bool is_task = false;
  std::size_t id = 0;
  bool operator>(const Event& other) const {
    return std::tie(time_s, is_task, id) > std::tie(other.time_s, other.is_task, other.id);
  }
};

double seconds_of(const Model& model, const std::vector<double>& seconds, std::size_t job) {
  if (bodice::engine::Random(8).uniform_at(job) < model.hung_share) return model.timeout_s;
  return seconds[bodice::engine::Random(7).bits_at(job) % seconds.size()];
}

class Simulation {
 public:
  Simulation(const Model& model, const std::vector<double>& seconds, std::size_t jobs)
      : model_(model), seconds_(seconds), losses_(model.seed, 1), began_(jobs, 0) {
    for (std::size_t shard = 0; shard < model.shards; ++shard) {
      Task task;
      for (std::size_t job = jobs * shard / model.shards; job < jobs * (shard + 1) / model.shards; ++job)
        task.push_back(static_cast<std::uint32_t>(job));
      if (!task.empty()) ready_.push_back(std::move(task));
    }
    const bodice::engine::Random draw(model.seed, 2);
    for (std::size_t node = 0; node < model.nodes; ++node) {
      factor_.push_back(draw.uniform_at(node) < model.slow_share ? model.slow_factor : 1.0);
      events_.push({0.0, false, node});
    }
  }

  Outcome run() {
    while (!events_.empty()) {
      const Event event = events_.top();
      events_.pop();
      if (event.is_task)
        ready_.push_back(std::move(requeued_[event.id]));
      else
        idle_.push_back(event.id);
      while (!ready_.empty() && !idle_.empty()) {
        const std::size_t node = idle_.front();
        idle_.pop_front();
        Task task = std::move(ready_.front());
        ready_.pop_front();
        start(node, std::move(task), event.time_s);
      }
    }
    outcome_.most_seen = began_.empty() ? 0 : *std::ranges::max_element(began_);
    return outcome_;
  }

 private:
  /// When the node will be lost, from now: exponential times need no memory of how long it was up.
  double next_loss_s() {
    if (model_.hours_to_loss <= 0.0) return kNever;
    return -3600.0 * model_.hours_to_loss * std::log(1.0 - losses_.uniform());
  }

  /// Runs the task's jobs in order on the first core that is free.
  void start(std::size_t node, Task task, double now_s) {
    const double loss_s = now_s + next_loss_s();
    std::priority_queue<double, std::vector<double>, std::greater<>> cores;
    for (int core = 0; core < model_.cores; ++core) cores.push(now_s + model_.start_s);
    Task left;
    double end_s = now_s + model_.start_s;
    for (const std::uint32_t job : task) {
      const double begin_s = cores.top();
      cores.pop();
      const double took_s = factor_[node] * seconds_of(model_, seconds_, job), done_s = begin_s + took_s;
      cores.push(done_s);
      if (begin_s < loss_s) ++began_[job];
      if (done_s <= loss_s) {
        outcome_.busy_s += took_s;
        end_s = std::max(end_s, done_s);
      } else {
        left.push_back(job);
        outcome_.wasted_s += std::max(0.0, loss_s - begin_s);
      }
    }
    outcome_.makespan_s = std::max(outcome_.makespan_s, end_s);
    if (left.empty()) return events_.push({end_s, false, node});
    ++outcome_.losses;
    events_.push({loss_s + model_.repair_s, false, node});
    events_.push({loss_s + model_.notice_s, true, requeued_.size()});
    requeued_.push_back(std::move(left));
  }

  const Model& model_;
  const std::vector<double>& seconds_;
  bodice::engine::Random losses_;
  std::vector<std::size_t> began_;
  std::vector<double> factor_;
  std::deque<Task> ready_;
  std::deque<std::size_t> idle_;
  std::vector<Task> requeued_;
  std::priority_queue<Event, std::vector<Event>, std::greater<>> events_;
  Outcome outcome_;
};

}  // namespace

Outcome simulate(const Model& model, const std::vector<double>& seconds, std::size_t jobs) {
  return Simulation(model, seconds, jobs).run();
}

double least_makespan_s(const Model& model, const std::vector<double>& seconds, std::size_t jobs) {
  double sum_s = 0.0, longest_s = 0.0;
  for (std::size_t job = 0; job < jobs; ++job) {
    sum_s += seconds_of(model, seconds, job);
    longest_s = std::max(longest_s, seconds_of(model, seconds, job));
  }
  return std::max(longest_s,
                  sum_s / static_cast<double>(model.nodes * static_cast<std::size_t>(model.cores)));
}

}  // namespace cluster
