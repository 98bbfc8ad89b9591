// A run of a task graph. Every worker takes the first of the ready tasks. A worker that makes more tasks
// ready than it can run calls further workers with a nested bulk. No worker waits for a task: one that finds
// none ready leaves, and is free for loops inside the tasks that still run. Between two tasks, workers share
// only a word of the ready set, and no lock.
#include <algorithm>

#include "graph_impl.hpp"

namespace bodice::inline v0_1::engine {
namespace {

// Each call of further workers nests one bulk deeper. At this depth all workers return and start again from
// the top.
constexpr int kMaxDepth = 32;

Error canceled_error(const std::string& task) {
  return Error{ErrorCode::kCanceled, "Canceled at '" + task + "'.", ""};
}

}  // namespace

struct TaskGraph::Impl::Run {
  Impl& graph;
  const Context& context;
  const OnProgress* on_progress;

  bool take(std::uint32_t& rank) {
    for (std::size_t position = 0; !graph.unwinding_ && graph.ready_.take_least(position);) {
      rank = graph.rank_at_[position];
      if (rank < graph.limit_) return true;
    }
    return false;
  }

  void execute(std::uint32_t rank, int depth) {
    const detail::GraphNode& node = graph.node(rank);
    try {
      context.checkpoint();
      Result<void> result;
      {
        TraceSpan span(context, node.name);
        result = node.body(context);
      }
      if (!result) return fail(rank, result.error(), nullptr);
      finish(rank, depth);
    } catch (const Canceled&) {
      cancel(rank);
    } catch (...) {
      fail(rank, std::nullopt, std::current_exception());
    }
  }

  void fail(std::size_t rank, std::optional<Error> error, std::exception_ptr exception) {
    const std::lock_guard lock(graph.failure_mutex_);
    if (rank >= graph.limit_) return;
    graph.limit_ = rank;
    graph.error_ = std::move(error);
    graph.exception_ = std::move(exception);
  }

  // A canceled run starts nothing more: its limit is below every rank. The first cancellation is reported.
  void cancel(std::uint32_t rank) {
    const std::lock_guard lock(graph.failure_mutex_);
    const bool first = !graph.error_ || graph.error_->code != ErrorCode::kCanceled;
    if (first) graph.error_ = canceled_error(graph.node(rank).name);
    graph.exception_ = nullptr;
    graph.limit_ = 0;
  }

  void finish(std::uint32_t rank, int depth) {
    std::unique_lock<std::mutex> in_order;
    if (on_progress) in_order = std::unique_lock(graph.progress_mutex_);
    graph.ended[rank] = 1;
    bool more = false;
    for (const std::uint32_t next : graph.successors[rank]) {
      if (graph.missing_[next].fetch_sub(1) != 1) continue;
      graph.ready_.insert(graph.position_of_[next]);
      more = true;
    }
    if (on_progress) (*on_progress)({++graph.tasks_ended_, graph.tasks_total, graph.node(rank).name});
    if (in_order) in_order.unlock();
    if (more) invite(depth);
  }

  // Calls as many further workers as there is work for. If the nest is too deep, all workers return and start
  // again instead.
  void invite(int depth) {
    const auto workers = static_cast<std::size_t>(context.executor->concurrency());
    const std::size_t working = graph.working_;
    if (working >= workers) return;
    const std::size_t ready = graph.ready_.count();
    if (ready < 2) return;
    if (depth == kMaxDepth) {
      graph.unwinding_ = true;
      return;
    }
    const std::size_t guests = std::min(ready - 1, workers - working);
    context.executor->bulk(guests + 1, [&](std::size_t) { work(depth + 1); });
  }

  void work(int depth) {
    do {
      ++graph.working_;
      for (std::uint32_t rank = 0; take(rank);) execute(rank, depth);
      --graph.working_;
      // Another worker may just have made tasks ready without calling further ones, because this one was at
      // work.
    } while (!graph.unwinding_ && !graph.ready_.empty());
  }

  void work_all() {
    const auto workers = static_cast<std::size_t>(context.executor->concurrency());
    for (std::size_t ready = graph.ready_.count(); ready > 0; ready = graph.ready_.count()) {
      graph.unwinding_ = false;
      context.executor->bulk(std::min(workers, ready), [&](std::size_t) { work(0); });
    }
  }
};

void TaskGraph::Impl::start() {
  tasks_ended_ = 0;
  limit_ = nodes.size();
  unwinding_ = false;
  error_.reset();
  exception_ = nullptr;
  ready_.clear();
  for (std::uint32_t rank = 0; rank < nodes.size(); ++rank) {
    missing_[rank] = needed_tasks[rank];
    if (!node(rank).is_input) ended[rank] = 0;
  }
}

Result<void> TaskGraph::Impl::run(const Context& context, const OnProgress* on_progress) {
  if (running_.exchange(true)) {
    return Error{ErrorCode::kInvalidArgument, "Task graph: it is running already.",
                 "Build one graph for each run at the same time."};
  }
  struct Guard {
    std::atomic<bool>& running;
    ~Guard() { running = false; }
  } guard{running_};

  start();
  Run run{*this, context, on_progress};
  for (std::uint32_t rank = 0; rank < nodes.size(); ++rank) {
    if (node(rank).is_input && !ended[rank]) {
      return Error{ErrorCode::kInvalidArgument, "Task graph: input '" + node(rank).name + "' was never set.",
                   "Call set() before run()."};
    }
    if (!node(rank).is_input && needed_tasks[rank] == 0) ready_.insert(position_of_[rank]);
  }
  run.work_all();
  if (exception_) std::rethrow_exception(std::exchange(exception_, nullptr));
  if (error_) return std::move(*error_);
  return {};
}

}  // namespace bodice::engine
