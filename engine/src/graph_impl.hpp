#pragma once

#include <atomic>
#include <exception>
#include <mutex>

#include <bodice/engine/task_graph.hpp>
#include <bodice/engine/trace.hpp>
#include "ready_set.hpp"

namespace bodice::inline v0_1::engine {

/// The checked nodes and all memory of a run. Tasks are numbered by their rank in topological order.
struct TaskGraph::Impl {
  Impl(std::vector<detail::GraphNode> nodes_in, std::vector<std::uint32_t> order);

  const detail::GraphNode& node(std::uint32_t rank) const { return nodes[node_at[rank]]; }

  Result<void> run(const Context& context, const OnProgress* on_progress);

  std::vector<detail::GraphNode> nodes;                // indexed by the number in an Output
  std::vector<std::uint32_t> node_at;                  // rank -> node
  std::vector<std::uint32_t> rank_of;                  // node -> rank
  std::vector<std::vector<std::uint32_t>> successors;  // rank -> ranks of the tasks that need it
  std::vector<std::uint32_t> needed_tasks;             // rank -> number of tasks (not inputs) that it needs
  std::size_t tasks_total = 0;
  std::vector<char> ended;  // by rank; an input has ended once it is set

 private:
  struct Run;
  void start();

  std::vector<std::uint32_t> rank_at_;      // position -> rank, in the order in which ready tasks start
  std::vector<std::uint32_t> position_of_;  // rank -> position

  ReadySet ready_;  // positions
  std::vector<std::atomic<std::uint32_t>> missing_;
  std::atomic<std::size_t> working_{0};  // threads in Run::work
  std::atomic<bool> unwinding_{false};
  std::atomic<std::size_t> limit_{0};  // tasks of this or a higher rank no longer start

  std::mutex failure_mutex_;
  std::optional<Error> error_;
  std::exception_ptr exception_;

  std::mutex progress_mutex_;
  std::size_t tasks_ended_ = 0;  // counted where progress is reported
  std::atomic<bool> running_{false};
};

}  // namespace bodice::engine
