#pragma once

#include <atomic>
#include <exception>
#include <mutex>

#include <bodice/engine/task_graph.hpp>
#include <bodice/engine/trace.hpp>
#include "ready_set.hpp"

namespace bodice::engine {

/// The checked nodes and all the memory of a run. Tasks are known by their rank in topological order.
struct TaskGraph::Impl {
  Impl(std::vector<detail::GraphNode> nodes_in, std::vector<std::uint32_t> order);

  const detail::GraphNode& node(std::uint32_t rank) const { return nodes[node_at[rank]]; }

  Result<void> run(const Context& context, const OnProgress* on_progress);

  std::vector<detail::GraphNode> nodes;                // by the number that an Output carries
  std::vector<std::uint32_t> node_at;                  // rank -> node
  std::vector<std::uint32_t> rank_of;                  // node -> rank
  std::vector<std::vector<std::uint32_t>> successors;  // by rank: ranks of tasks
  std::vector<std::uint32_t> needed_tasks;             // by rank: how many tasks (not inputs) it needs
  std::size_t tasks_total = 0;
  std::vector<char> ended;  // by rank; an input has ended when it was set

 private:
  struct Run;
  void start();

  std::vector<std::uint32_t> rank_at_;   // place -> rank; places in the order in which ready tasks start
  std::vector<std::uint32_t> place_of_;  // rank -> place

  ReadySet ready_;  // places
  std::vector<std::atomic<std::uint32_t>> missing_;
  std::atomic<std::size_t> working_{0};  // threads in Run::work
  std::atomic<bool> unwinding_{false};
  std::atomic<std::size_t> limit_{0};  // tasks of this rank or a higher one no longer start

  std::mutex failure_mutex_;
  std::optional<Error> error_;
  std::exception_ptr exception_;

  std::mutex progress_mutex_;
  std::size_t tasks_ended_ = 0;  // counted where progress is told
  std::atomic<bool> running_{false};
};

}  // namespace bodice::engine
