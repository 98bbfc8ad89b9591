#include <algorithm>
#include <functional>
#include <map>
#include <queue>
#include <string_view>

#include "graph_impl.hpp"

namespace bodice::inline v0_1::engine {

struct GraphBuilder::Impl {
  std::vector<detail::GraphNode> nodes;
  std::optional<std::string> misuse;  // the first mistake that is found in a call instead of in build()
};

namespace {

Error graph_error(std::string message, std::string remedy) {
  return Error{ErrorCode::kInvalidArgument, "Task graph: " + std::move(message), std::move(remedy)};
}

std::optional<Error> find_bad_node(const std::vector<detail::GraphNode>& nodes) {
  std::map<std::string_view, int> uses;
  for (const detail::GraphNode& node : nodes) {
    if (++uses[node.name] > 1) {
      return graph_error("two tasks are named '" + node.name + "'.", "Give each task a name of its own.");
    }
  }
  for (const detail::GraphNode& node : nodes) {
    for (const std::uint32_t needed : node.needs) {
      if (nodes[needed].is_input || nodes[needed].body) continue;
      return graph_error(
          "'" + node.name + "' needs '" + nodes[needed].name + "', which was declared but not defined.",
          "Call define() for it.");
    }
  }
  for (const detail::GraphNode& node : nodes) {
    if (!node.is_input && !node.body) {
      return graph_error("'" + node.name + "' was declared but not defined.", "Call define() for it.");
    }
  }
  return std::nullopt;
}

// Sorts by Kahn's algorithm, least number first, so that the order is a function of the graph alone.
std::vector<std::uint32_t> topological_order(const std::vector<detail::GraphNode>& nodes) {
  std::vector<std::size_t> missing(nodes.size());
  std::vector<std::vector<std::uint32_t>> successors(nodes.size());
  std::priority_queue<std::uint32_t, std::vector<std::uint32_t>, std::greater<>> ready;
  for (std::uint32_t i = 0; i < nodes.size(); ++i) {
    missing[i] = nodes[i].needs.size();
    if (missing[i] == 0) ready.push(i);
    for (const std::uint32_t needed : nodes[i].needs) successors[needed].push_back(i);
  }
  std::vector<std::uint32_t> order;
  while (!ready.empty()) {
    order.push_back(ready.top());
    ready.pop();
    for (const std::uint32_t next : successors[order.back()]) {
      if (--missing[next] == 0) ready.push(next);
    }
  }
  return order;
}

// Walks back along needs that have no rank until a task repeats: the part between is a cycle.
std::string describe_cycle(const std::vector<detail::GraphNode>& nodes, const std::vector<bool>& placed) {
  std::vector<std::uint32_t> path;
  auto at = static_cast<std::uint32_t>(std::ranges::find(placed, false) - placed.begin());
  while (std::ranges::find(path, at) == path.end()) {
    path.push_back(at);
    at = *std::ranges::find_if(nodes[at].needs, [&](std::uint32_t needed) { return !placed[needed]; });
  }
  std::string text = "'" + nodes[at].name + "'";
  for (auto step = path.rbegin(); step != path.rend(); ++step) {
    text += " -> '" + nodes[*step].name + "'";
    if (*step == at) break;
  }
  return text;
}

}  // namespace

GraphBuilder::GraphBuilder() : impl_(std::make_unique<Impl>()) {}
GraphBuilder::~GraphBuilder() = default;
GraphBuilder::GraphBuilder(GraphBuilder&&) noexcept = default;
GraphBuilder& GraphBuilder::operator=(GraphBuilder&&) noexcept = default;

std::uint32_t GraphBuilder::add_node(std::string name, bool is_input, std::shared_ptr<void> slot) {
  impl_->nodes.push_back(
      {.name = std::move(name), .body = {}, .is_input = is_input, .slot = std::move(slot)});
  return static_cast<std::uint32_t>(impl_->nodes.size() - 1);
}

void GraphBuilder::set_body(std::uint32_t node, const std::shared_ptr<void>& slot, detail::TaskBody body) {
  if (node >= impl_->nodes.size() || impl_->nodes[node].slot != slot) {
    if (!impl_->misuse) impl_->misuse = "define() was given an Output of another graph.";
    return;
  }
  detail::GraphNode& task = impl_->nodes[node];
  if ((task.body || task.is_input) && !impl_->misuse) impl_->misuse = "'" + task.name + "' is defined twice.";
  task.body = std::move(body);
}

void GraphBuilder::need(std::uint32_t node, std::uint32_t needed, const std::shared_ptr<void>& slot) {
  const bool known = needed < impl_->nodes.size() && impl_->nodes[needed].slot == slot;
  if (known && node < impl_->nodes.size()) {
    auto& needs = impl_->nodes[node].needs;
    if (std::ranges::find(needs, needed) == needs.end()) needs.push_back(needed);
  } else if (!impl_->misuse) {
    const std::string name = node < impl_->nodes.size() ? impl_->nodes[node].name : "?";
    impl_->misuse = "'" + name + "' needs an input that is not part of this graph.";
  }
}

void GraphBuilder::set_node_priority(std::uint32_t node, int priority) {
  if (node < impl_->nodes.size()) impl_->nodes[node].priority = priority;
}

Result<TaskGraph> GraphBuilder::build() && {
  const std::vector<detail::GraphNode>& nodes = impl_->nodes;
  if (impl_->misuse) return graph_error(*impl_->misuse, "Use the Output that this builder returned, once.");
  if (auto error = find_bad_node(nodes)) return std::move(*error);
  const std::vector<std::uint32_t> order = topological_order(nodes);
  if (order.size() < nodes.size()) {
    std::vector<bool> placed(nodes.size(), false);
    for (const std::uint32_t node : order) placed[node] = true;
    return graph_error("a cycle: " + describe_cycle(nodes, placed) + ".", "Break one of these dependencies.");
  }
  return TaskGraph(std::make_unique<TaskGraph::Impl>(std::move(impl_->nodes), order));
}

}  // namespace bodice::engine
