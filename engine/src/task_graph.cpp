#include <bodice/engine/task_graph.hpp>

#include <algorithm>
#include <functional>
#include <numeric>

#include "graph_impl.hpp"

namespace bodice::inline v0_1::engine {

TaskGraph::Impl::Impl(std::vector<detail::GraphNode> nodes_in, std::vector<std::uint32_t> order)
    : nodes(std::move(nodes_in)),
      node_at(std::move(order)),
      rank_of(nodes.size()),
      successors(nodes.size()),
      needed_tasks(nodes.size(), 0),
      ended(nodes.size(), 0) {
  for (std::uint32_t rank = 0; rank < nodes.size(); ++rank) rank_of[node_at[rank]] = rank;
  for (std::uint32_t rank = 0; rank < nodes.size(); ++rank) {
    if (!node(rank).is_input) ++tasks_total;
    for (const std::uint32_t needed : node(rank).needs) {
      if (nodes[needed].is_input) continue;
      successors[rank_of[needed]].push_back(rank);
      ++needed_tasks[rank];
    }
  }
  rank_at_ = std::vector<std::uint32_t>(nodes.size());
  std::iota(rank_at_.begin(), rank_at_.end(), 0u);
  std::ranges::stable_sort(rank_at_, std::ranges::greater(),
                           [this](std::uint32_t rank) { return node(rank).priority; });
  position_of_.resize(nodes.size());
  for (std::uint32_t position = 0; position < nodes.size(); ++position)
    position_of_[rank_at_[position]] = position;
  ready_.resize(nodes.size());
  missing_ = std::vector<std::atomic<std::uint32_t>>(nodes.size());
}

TaskGraph::TaskGraph(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
TaskGraph::~TaskGraph() = default;
TaskGraph::TaskGraph(TaskGraph&&) noexcept = default;
TaskGraph& TaskGraph::operator=(TaskGraph&&) noexcept = default;

Result<void> TaskGraph::run(const Context& context) {
  return impl_->run(context, nullptr);
}
Result<void> TaskGraph::run(const Context& context, OnProgress on_progress) {
  return impl_->run(context, &on_progress);
}

std::size_t TaskGraph::size() const {
  return impl_->tasks_total;
}

void TaskGraph::mark_set(std::uint32_t node, const std::shared_ptr<void>& slot) {
  if (node >= impl_->nodes.size() || impl_->nodes[node].slot != slot) return;
  if (impl_->nodes[node].is_input) impl_->ended[impl_->rank_of[node]] = 1;
}

void TaskGraph::mark_taken(std::uint32_t node, const std::shared_ptr<void>& slot) {
  if (node >= impl_->nodes.size() || impl_->nodes[node].slot != slot) return;
  impl_->ended[impl_->rank_of[node]] = 0;
}

bool TaskGraph::ended(std::uint32_t node, const std::shared_ptr<void>& slot) const {
  return node < impl_->nodes.size() && impl_->nodes[node].slot == slot &&
         impl_->ended[impl_->rank_of[node]] != 0;
}

std::string TaskGraph::dump_dot() const {
  auto quoted = [](const std::string& name) {
    std::string text = "\"";
    for (const char c : name) text += (c == '"' || c == '\\') ? std::string{'\\', c} : std::string{c};
    return text + '"';
  };
  std::string dot = "digraph tasks {\n  rankdir=LR;\n";
  for (std::uint32_t rank = 0; rank < impl_->nodes.size(); ++rank) {
    const detail::GraphNode& node = impl_->node(rank);
    dot += "  " + quoted(node.name) + (node.is_input ? " [shape=box];\n" : ";\n");
    for (const std::uint32_t needed : node.needs) {
      dot += "  " + quoted(impl_->nodes[needed].name) + " -> " + quoted(node.name) + ";\n";
    }
  }
  return dot + "}\n";
}

}  // namespace bodice::engine
