// A run of a task graph. Every worker draws the best ready task from one heap; the worker that makes more
// tasks ready than it can run itself invites others with a nested bulk. Nobody waits for a task: a worker
// that finds the heap empty leaves, so that it is free for loops inside the tasks that still run.
#include <algorithm>

#include "graph_impl.hpp"

namespace bodice::engine {
namespace {

// Each invitation nests one bulk deeper; past this depth all workers return and start afresh from the top.
constexpr int kMaxDepth = 32;

Error cancelled_error(const std::string& task) {
  return Error{ErrorCode::kCancelled, "Cancelled at '" + task + "'.", ""};
}

}  // namespace

struct TaskGraph::Impl::Run {
  Impl& graph;
  const Context& context;
  const OnProgress* on_progress;

  bool starts_later(std::uint32_t a, std::uint32_t b) const {
    const int priority_a = graph.node(a).priority, priority_b = graph.node(b).priority;
    return priority_a != priority_b ? priority_a < priority_b : a > b;
  }
  auto heap_order() const {
    return [this](std::uint32_t a, std::uint32_t b) { return starts_later(a, b); };
  }

  void push(std::uint32_t rank) {
    graph.ready_.push_back(rank);
    std::ranges::push_heap(graph.ready_, heap_order());
  }

  // Takes the next task into `rank`, or leaves work() and returns false.
  bool pop(std::uint32_t& rank) {
    const std::lock_guard lock(graph.mutex_);
    while (!graph.unwinding_ && !graph.ready_.empty()) {
      std::ranges::pop_heap(graph.ready_, heap_order());
      rank = graph.ready_.back();
      graph.ready_.pop_back();
      if (rank <= graph.failed_rank_) return true;
    }
    --graph.working_;
    return false;
  }

  void fail(std::size_t rank, std::optional<Error> error, std::exception_ptr exception) {
    const std::lock_guard lock(graph.mutex_);
    if (rank >= graph.failed_rank_) return;
    graph.failed_rank_ = rank;
    graph.error_ = std::move(error);
    graph.exception_ = std::move(exception);
  }

  void execute(std::uint32_t rank) {
    const detail::GraphNode& node = graph.node(rank);
    try {
      context.checkpoint();
      Result<void> result;
      {
        TraceSpan span(context, node.name);
        result = node.body(context);
      }
      if (!result) return fail(rank, result.error(), nullptr);
      finish(rank);
    } catch (const Cancelled&) {
      cancel(rank);
    } catch (...) {
      fail(rank, std::nullopt, std::current_exception());
    }
  }

  // A cancelled run starts nothing more, so it takes the place below every rank; the first one is told.
  void cancel(std::uint32_t rank) {
    const std::lock_guard lock(graph.mutex_);
    const bool first = !graph.error_ || graph.error_->code != ErrorCode::kCancelled;
    if (first) graph.error_ = cancelled_error(graph.node(rank).name);
    graph.exception_ = nullptr;
    graph.failed_rank_ = 0;
    graph.ready_.clear();
  }

  void finish(std::uint32_t rank) {
    std::unique_lock<std::mutex> in_order;
    if (on_progress) in_order = std::unique_lock(graph.progress_mutex_);
    std::size_t ended = 0;
    {
      const std::lock_guard lock(graph.mutex_);
      graph.ended[rank] = 1;
      ended = ++graph.tasks_ended_;
      for (const std::uint32_t next : graph.successors[rank]) {
        if (--graph.missing_[next] == 0) push(next);
      }
    }
    if (on_progress) (*on_progress)({ended, graph.tasks_total, graph.node(rank).name});
  }

  // How many more workers have something to do; with too deep a nest, tells all to return instead.
  std::size_t invitations(int depth) {
    const std::lock_guard lock(graph.mutex_);
    const auto workers = static_cast<std::size_t>(context.executor->concurrency());
    if (graph.ready_.size() < 2 || graph.working_ >= workers) return 0;
    if (depth < kMaxDepth) return std::min(graph.ready_.size() - 1, workers - graph.working_);
    graph.unwinding_ = true;
    return 0;
  }

  void work(int depth) {
    {
      const std::lock_guard lock(graph.mutex_);
      ++graph.working_;
    }
    for (std::uint32_t rank = 0; pop(rank);) {
      execute(rank);
      const std::size_t more = invitations(depth);
      if (more > 0) context.executor->bulk(more + 1, [&](std::size_t) { work(depth + 1); });
    }
  }

  void work_all() {
    do {
      graph.unwinding_ = false;
      const auto workers = static_cast<std::size_t>(context.executor->concurrency());
      context.executor->bulk(std::min(workers, graph.ready_.size()), [&](std::size_t) { work(0); });
    } while (!graph.ready_.empty());
  }
};

void TaskGraph::Impl::start() {
  tasks_ended_ = 0;
  failed_rank_ = nodes.size();
  error_.reset();
  exception_ = nullptr;
  ready_.clear();
  missing_ = needed_tasks;
  for (std::uint32_t rank = 0; rank < nodes.size(); ++rank) {
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
    if (!node(rank).is_input && needed_tasks[rank] == 0) run.push(rank);
  }
  if (!ready_.empty()) run.work_all();
  if (exception_) std::rethrow_exception(std::exchange(exception_, nullptr));
  if (error_) return std::move(*error_);
  return {};
}

}  // namespace bodice::engine
