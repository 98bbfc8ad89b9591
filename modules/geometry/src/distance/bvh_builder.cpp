#include "distance/bvh_builder.hpp"

#include <cmath>
#include <numeric>

#include <bodice/engine/parallel.hpp>

namespace bodice::inline v0_1::geometry {
namespace {

constexpr int kBins = 16;
// A node of more triangles than this builds its children in tasks of their own.
constexpr std::uint32_t kParallelNode = 2048;
// Binary levels that are split by surface area. Deeper ones are halved, which bounds the depth.
constexpr int kSahLevels = 40;

float round_down(double value) {
  return std::nextafter(static_cast<float>(value), -std::numeric_limits<float>::infinity());
}
float round_up(double value) {
  return std::nextafter(static_cast<float>(value), std::numeric_limits<float>::infinity());
}

struct Primitive {
  FloatBox box;
  std::array<float, 3> centroid;
};

Primitive make_primitive(const BvhTriangle& t) {
  Primitive p{.box = float_box(t), .centroid = {}};
  for (int k = 0; k < 3; ++k) p.centroid[k] = 0.5f * (p.box.low[k] + p.box.high[k]);
  return p;
}

struct Range {
  std::uint32_t begin = 0, end = 0;
  std::uint32_t size() const { return end - begin; }
};

struct Split {
  int axis = 0;
  float origin = 0.0f, bins_per_unit = 0.0f;
  int bin = 0;  // the first bin of the right side; 0 means that no split was found
  int bin_of(const Primitive& p) const {
    return std::clamp(static_cast<int>((p.centroid[axis] - origin) * bins_per_unit), 0, kBins - 1);
  }
};

/// The sums of a sweep over the bins of one axis. It finds the plane (of kBins - 1) that costs least: n_left
/// area_left + n_right area_right.
struct BinSweep {
  std::array<FloatBox, kBins> boxes;
  std::array<std::uint32_t, kBins> counts{};

  std::pair<float, int> best() const {
    std::array<float, kBins> right_cost{};
    FloatBox box;
    std::uint32_t count = 0;
    for (int i = kBins - 1; i > 0; --i) {
      box.extend(boxes[i]);
      count += counts[i];
      right_cost[i] = box.half_area() * static_cast<float>(count);
    }
    const std::uint32_t total = count + counts[0];
    std::pair<float, int> result{std::numeric_limits<float>::infinity(), 0};
    box = {};
    count = 0;
    for (int i = 1; i < kBins; ++i) {
      box.extend(boxes[i - 1]);
      count += counts[i - 1];
      const float cost = box.half_area() * static_cast<float>(count) + right_cost[i];
      if (count > 0 && count < total && cost < result.first) result = {cost, i};
    }
    return result;
  }
};

class Builder {
 public:
  explicit Builder(const std::vector<BvhTriangle>& triangles)
      : order_(triangles.size()), leaf_size_(triangles.size(), 0) {
    primitives_.reserve(triangles.size());
    for (const BvhTriangle& t : triangles) primitives_.push_back(make_primitive(t));
    std::iota(order_.begin(), order_.end(), 0u);
  }

  void build(const engine::Context& context, std::vector<BvhNode>& nodes,
             std::vector<LeafTriangles>& leaves) {
    nodes.emplace_back();
    fill(context, nodes, 0, {0, static_cast<std::uint32_t>(order_.size())}, 0);
    number_leaves(nodes, leaves);
  }
  const std::vector<std::uint32_t>& order() const { return order_; }

 private:
  /// Replaces the first triangle, by which a child names its leaf, by the leaf's number once all nodes exist.
  void number_leaves(std::vector<BvhNode>& nodes, std::vector<LeafTriangles>& leaves) const {
    for (BvhNode& node : nodes)
      for (std::uint32_t& child : node.child) {
        if (child == BvhChild::kNone || !BvhChild::is_leaf(child)) continue;
        const std::uint32_t first = BvhChild::leaf_index(child);
        child = BvhChild::leaf(static_cast<std::uint32_t>(leaves.size()));
        leaves.push_back({.first = first, .count = leaf_size_[first]});
      }
  }

  /// Sets the children of nodes[index], which covers the range.
  void fill(const engine::Context& context, std::vector<BvhNode>& nodes, std::uint32_t index, Range range,
            int level) {
    std::array<Range, BvhNode::kWidth> parts;
    int count = 1;
    parts[0] = range;
    for (int round = 0; round < 2; ++round)
      for (int i = 0, before = count; i < before; ++i)
        if (parts[i].size() > Bvh::kLeafSize) {
          const std::uint32_t middle = split(parts[i], level + round);
          parts[count++] = {middle, parts[i].end};
          parts[i].end = middle;
        }
    std::array<std::uint32_t, BvhNode::kWidth> child;
    if (range.size() > kParallelNode) {
      add_in_parallel(context, nodes, parts, level + 2, child);
    } else {
      for (int i = 0; i < BvhNode::kWidth; ++i) child[i] = add_part(context, nodes, parts[i], level + 2);
    }
    for (int i = 0; i < BvhNode::kWidth; ++i) set_child(nodes[index], i, parts[i], child[i]);
  }

  std::uint32_t add_part(const engine::Context& context, std::vector<BvhNode>& nodes, Range part, int level) {
    if (part.size() == 0) return BvhChild::kNone;
    if (part.size() <= Bvh::kLeafSize) {
      leaf_size_[part.begin] = static_cast<std::uint8_t>(part.size());
      return BvhChild::leaf(part.begin);
    }
    const auto child = static_cast<std::uint32_t>(nodes.size());
    nodes.emplace_back();
    fill(context, nodes, child, part, level);
    return child;
  }

  /// Builds the parts side by side, then joins their nodes in the order of a serial build.
  void add_in_parallel(const engine::Context& context, std::vector<BvhNode>& nodes,
                       const std::array<Range, BvhNode::kWidth>& parts, int level,
                       std::array<std::uint32_t, BvhNode::kWidth>& child) {
    std::array<std::vector<BvhNode>, BvhNode::kWidth> own;
    engine::parallel_for(context, BvhNode::kWidth, 1, [&](std::size_t i, std::size_t) {
      child[i] = add_part(context, own[i], parts[i], level);
    });
    for (int i = 0; i < BvhNode::kWidth; ++i) {
      const auto base = static_cast<std::uint32_t>(nodes.size());
      const auto moved = [base](std::uint32_t c) {
        return c == BvhChild::kNone || BvhChild::is_leaf(c) ? c : c + base;
      };
      for (BvhNode& node : own[i]) {
        for (std::uint32_t& c : node.child) c = moved(c);
        nodes.push_back(node);
      }
      child[i] = moved(child[i]);
    }
  }

  void set_child(BvhNode& node, int slot, Range part, std::uint32_t child) const {
    FloatBox box;
    for (std::uint32_t i = part.begin; i < part.end; ++i) box.extend(primitives_[order_[i]].box);
    for (int k = 0; k < 3; ++k) {
      node.low[k][slot] = box.low[k];
      node.high[k][slot] = box.high[k];
    }
    node.child[slot] = child;
  }

  /// Partitions the range and returns the first of its right side; both sides are non-empty.
  std::uint32_t split(Range range, int level) {
    const auto begin = order_.begin() + range.begin;
    const auto end = order_.begin() + range.end;
    const Split choice = level < kSahLevels ? choose(range) : Split{};
    if (choice.bin > 0) {
      const auto middle = std::stable_partition(
          begin, end, [&](std::uint32_t i) { return choice.bin_of(primitives_[i]) < choice.bin; });
      return static_cast<std::uint32_t>(middle - order_.begin());
    }
    return range.begin + range.size() / 2;
  }

  Split choose(Range range) const {
    FloatBox centroids;
    for (std::uint32_t i = range.begin; i < range.end; ++i) {
      const Primitive& p = primitives_[order_[i]];
      FloatBox point;
      point.low = point.high = p.centroid;
      centroids.extend(point);
    }
    Split best;
    float best_cost = std::numeric_limits<float>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
      const float extent = centroids.high[axis] - centroids.low[axis];
      if (!(extent > 0.0f)) continue;
      Split candidate{axis, centroids.low[axis], kBins / extent, 0};
      const auto [cost, bin] = sweep(range, candidate).best();
      if (cost >= best_cost) continue;
      best_cost = cost;
      best = candidate;
      best.bin = bin;
    }
    return best;
  }

  BinSweep sweep(Range range, const Split& split) const {
    BinSweep result;
    for (std::uint32_t i = range.begin; i < range.end; ++i) {
      const Primitive& p = primitives_[order_[i]];
      const int bin = split.bin_of(p);
      result.boxes[bin].extend(p.box);
      ++result.counts[bin];
    }
    return result;
  }

  std::vector<Primitive> primitives_;
  std::vector<std::uint32_t> order_;
  std::vector<std::uint8_t> leaf_size_;  // #triangles: the size of the leaf that begins at each, or 0
};

}  // namespace

FloatBox float_box(const BvhTriangle& t) {
  FloatBox box;
  const Vec3 b = t.a + t.ab;
  const Vec3 c = t.a + t.ac;
  for (int k = 0; k < 3; ++k) {
    box.low[k] = round_down(std::min({t.a[k], b[k], c[k]}));
    box.high[k] = round_up(std::max({t.a[k], b[k], c[k]}));
  }
  return box;
}

BvhNodes divide_triangles(const engine::Context& context, const std::vector<BvhTriangle>& triangles) {
  Builder builder(triangles);
  BvhNodes divided;
  builder.build(context, divided.nodes, divided.leaves);
  divided.order = builder.order();
  return divided;
}

}  // namespace bodice::geometry
