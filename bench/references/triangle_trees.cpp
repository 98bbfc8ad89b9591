#include <bench_references/triangle_trees.hpp>

#include <algorithm>
#include <limits>
#include <numeric>

#include <Eigen/Geometry>

namespace bench {

using bodice::geometry::Vec3;

namespace {

constexpr std::uint32_t kLeaf = 4;

/// The squared distance of a point from a triangle.
/// Based on: Christer Ericson. Real-Time Collision Detection. 2005. - section 5.1.5
double squared_distance(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto to_edge = [&](const Vec3& from, const Vec3& to) {
    const Vec3 edge = to - from;
    const double t = std::clamp((p - from).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
    return (p - from - t * edge).squaredNorm();
  };
  const Vec3 normal = (b - a).cross(c - a);
  const bool above = normal.dot((b - a).cross(p - a)) >= 0.0 && normal.dot((c - b).cross(p - b)) >= 0.0 &&
                     normal.dot((a - c).cross(p - c)) >= 0.0;
  if (!above) return std::min({to_edge(a, b), to_edge(b, c), to_edge(c, a)});
  const double height = normal.dot(p - a);
  return height * height / normal.squaredNorm();
}

}  // namespace

TriangleTree::TriangleTree(const bodice::geometry::TriMesh& mesh)
    : mesh_(mesh), order_(mesh.triangles.size()) {
  for (const auto& t : mesh.triangles)
    middle_.push_back((mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]) / 3.0);
  std::iota(order_.begin(), order_.end(), 0u);
  nodes_.emplace_back();
  split(0, 0, static_cast<std::uint32_t>(order_.size()));
  middle_ = {};
  refit();
}

void TriangleTree::split(std::uint32_t node, std::uint32_t begin, std::uint32_t end) {
  nodes_[node].first = begin;
  nodes_[node].count = end - begin;
  if (end - begin <= kLeaf) return;
  bodice::geometry::Box box;
  for (std::uint32_t i = begin; i < end; ++i) box.extend(middle_[order_[i]]);
  Eigen::Index axis;
  (box.high - box.low).maxCoeff(&axis);
  const std::uint32_t half = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + half, order_.begin() + end,
                   [&](std::uint32_t a, std::uint32_t b) { return middle_[a][axis] < middle_[b][axis]; });
  const auto child = static_cast<std::uint32_t>(nodes_.size());
  nodes_[node].first = child;
  nodes_[node].count = 0;
  nodes_.resize(nodes_.size() + 2);
  split(child, begin, half);
  split(child + 1, half, end);
}

void TriangleTree::enclose(Node& node) const {
  for (int axis = 0; axis < 3; ++axis) {
    float low = std::numeric_limits<float>::max(), high = -low;
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
      for (const auto v : mesh_.triangles[order_[i]]) {
        const auto at = static_cast<float>(mesh_.positions[static_cast<std::size_t>(v)][axis]);
        low = std::min(low, at);
        high = std::max(high, at);
      }
    node.low[axis] = low;
    node.high[axis] = high;
  }
}

void TriangleTree::refit() {
  // Children come after their parents.
  for (std::size_t i = nodes_.size(); i-- > 0;) {
    Node& node = nodes_[i];
    if (node.count > 0) {
      enclose(node);
      continue;
    }
    const Node &a = nodes_[node.first], &b = nodes_[node.first + 1];
    for (int axis = 0; axis < 3; ++axis) {
      node.low[axis] = std::min(a.low[axis], b.low[axis]);
      node.high[axis] = std::max(a.high[axis], b.high[axis]);
    }
  }
}

bool TriangleTree::apart(const Node& a, const Node& b, float thickness_m) {
  for (int axis = 0; axis < 3; ++axis)
    if (a.low[axis] > b.high[axis] + thickness_m || b.low[axis] > a.high[axis] + thickness_m) return true;
  return false;
}

std::size_t TriangleTree::count_leaves(const Node& mine, const TriangleTree& body, const Node& other,
                                       double thickness_m) const {
  std::size_t found = 0;
  for (std::uint32_t i = mine.first; i < mine.first + mine.count; ++i)
    for (const auto v : mesh_.triangles[order_[i]]) {
      const Vec3& p = mesh_.positions[static_cast<std::size_t>(v)];
      for (std::uint32_t j = other.first; j < other.first + other.count; ++j) {
        const auto& t = body.mesh_.triangles[body.order_[j]];
        const auto& at = body.mesh_.positions;
        found += squared_distance(p, at[t[0]], at[t[1]], at[t[2]]) < thickness_m * thickness_m;
      }
    }
  return found;
}

std::size_t TriangleTree::count_contacts(const TriangleTree& body, double thickness_m) const {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> open{{0, 0}};
  std::size_t found = 0;
  while (!open.empty()) {
    const auto [i, j] = open.back();
    open.pop_back();
    const Node &mine = nodes_[i], &other = body.nodes_[j];
    if (apart(mine, other, static_cast<float>(thickness_m))) continue;
    if (mine.count > 0 && other.count > 0) {
      found += count_leaves(mine, body, other, thickness_m);
    } else if (other.count == 0 &&
               (mine.count > 0 || other.high[1] - other.low[1] > mine.high[1] - mine.low[1])) {
      open.emplace_back(i, other.first);
      open.emplace_back(i, other.first + 1);
    } else {
      open.emplace_back(mine.first, j);
      open.emplace_back(mine.first + 1, j);
    }
  }
  return found;
}

}  // namespace bench
