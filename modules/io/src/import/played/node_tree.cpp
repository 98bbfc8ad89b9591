#include "import/played/node_tree.hpp"

namespace bodice::inline v0_1::io {

namespace {

using engine::SortedJson;

/// The numbers under a key; `size` of them, or none.
std::vector<double> numbers_at(const SortedJson& node, const char* key, std::size_t size) {
  std::vector<double> values;
  for (const SortedJson& value : array_at(node, key))
    if (value.is_number()) values.push_back(value.get<double>());
  if (values.size() != size) values.clear();
  return values;
}

rig::LocalTransform local_of(const SortedJson& node) {
  rig::LocalTransform local;
  if (const auto t = numbers_at(node, "translation", 3); !t.empty())
    local.translation = geometry::Vec3(t[0], t[1], t[2]);
  if (const auto q = numbers_at(node, "rotation", 4); !q.empty())
    local.rotation = Eigen::Quaterniond(q[3], q[0], q[1], q[2]).normalized();
  if (const auto s = numbers_at(node, "scale", 3); !s.empty()) local.scale = geometry::Vec3(s[0], s[1], s[2]);
  return local;
}

Eigen::Affine3d affine_of(const rig::LocalTransform& local) {
  return Eigen::Translation3d(local.translation) * local.rotation * Eigen::Scaling(local.scale);
}

}  // namespace

NodeTree::NodeTree(const GltfDocument& document) : document_(document) {
  const SortedJson& nodes = array_at(document.root(), "nodes");
  parent_.assign(nodes.size(), kNoParent);
  for (const SortedJson& node : nodes) local_.push_back(local_of(node));
  for (std::size_t n = 0; n < nodes.size(); ++n)
    for (const SortedJson& child : array_at(nodes[n], "children"))
      if (child.is_number_unsigned() && child.get<std::size_t>() < parent_.size())
        parent_[child.get<std::size_t>()] = static_cast<std::ptrdiff_t>(n);
  for (std::ptrdiff_t& parent : parent_) {  // a walk upward that is longer than all nodes is a ring
    std::size_t steps = 0;
    for (std::ptrdiff_t up = parent; up != kNoParent && steps <= parent_.size();
         up = parent_[static_cast<std::size_t>(up)])
      ++steps;
    if (steps > parent_.size()) parent = kNoParent;
  }
}

bool NodeTree::is_top(std::size_t node) const {
  const std::ptrdiff_t up = parent_[node];
  return up == kNoParent ||
         (parent_[static_cast<std::size_t>(up)] == kNoParent &&
          text_at(document_.element("nodes", static_cast<std::size_t>(up)), "name") == "input");
}

std::optional<std::size_t> NodeTree::find_top(std::string_view name) const {
  std::optional<std::size_t> found;
  for (std::size_t n = 0; n < size(); ++n) {
    const SortedJson& node = document_.element("nodes", n);
    if (!is_top(n) || text_at(node, "name") != name) continue;
    if (index_at(node, "mesh")) return n;
    if (!found) found = n;
  }
  return found;
}

Eigen::Affine3d NodeTree::world(std::size_t node) const {
  return world_with(node, local_[node]);
}

Eigen::Affine3d NodeTree::world_with(std::size_t node, const rig::LocalTransform& local) const {
  Eigen::Affine3d map = affine_of(local);
  for (std::ptrdiff_t up = parent_[node]; up != kNoParent; up = parent_[static_cast<std::size_t>(up)])
    map = affine_of(local_[static_cast<std::size_t>(up)]) * map;
  return map;
}

}  // namespace bodice::io
