// Based on: Ulrich Meyer, Peter Sanders. Delta-stepping: a parallelizable shortest path algorithm. 2003.
// Differs: one thread a run (sources run in parallel); a circular array of buckets no wider than a typical
// link. Rounded addition is monotone, so the least fixed point, and with it every bit of the result, is
// Dijkstra's.
#include <algorithm>
#include <cmath>

#include <bodice/engine/parallel.hpp>
#include <bodice/geodesic/distance.hpp>

namespace bodice::geodesic {
namespace {

using geometry::Index;
using geometry::kNoIndex;

/// Bucket width in mean link lengths: wide enough to visit few empty buckets, narrow enough to settle few
/// vertices twice.
constexpr float kBucketWidth = 0.75F;
/// Meshes whose longest link is thousands of times the mean get wider buckets instead of more.
constexpr std::size_t kMostBuckets = 1 << 12;

class Buckets {
 public:
  explicit Buckets(const EdgeGraph& graph) {
    const float wanted = kBucketWidth * graph.mean;
    const float least = graph.longest / static_cast<float>(kMostBuckets - 2);
    const float width = std::max({wanted, least, std::numeric_limits<float>::min()});
    scale_ = 1.0F / width;
    ring_.resize(static_cast<std::size_t>(graph.longest * scale_) + 3);
  }
  void push(Index vertex, float distance) {
    ring_[slot(distance) % ring_.size()].push_back({vertex, distance});
    ++size_;
  }
  /// Precondition: not empty.
  Seed pop() {
    while (ring_[current_ % ring_.size()].empty()) ++current_;
    auto& bucket = ring_[current_ % ring_.size()];
    const Seed entry = bucket.back();
    bucket.pop_back();
    --size_;
    return entry;
  }
  bool empty() const { return size_ == 0; }

 private:
  std::size_t slot(float distance) const {
    return std::max(current_, static_cast<std::size_t>(distance * scale_));
  }
  std::vector<std::vector<Seed>> ring_;
  float scale_ = 1.0F;
  std::size_t current_ = 0;
  std::size_t size_ = 0;
};

/// Seeds that start later than one ring ahead would alias an earlier bucket, so they wait, sorted, outside.
template <class Reached>
void run(const EdgeGraph& graph, std::vector<Seed> seeds, Field& field, Reached reached) {
  Buckets buckets(graph);
  std::stable_sort(seeds.begin(), seeds.end(),
                   [](const Seed& a, const Seed& b) { return a.distance < b.distance; });
  std::size_t waiting = 0;
  float horizon = 0.0F;
  while (waiting < seeds.size() || !buckets.empty()) {
    if (buckets.empty()) horizon = seeds[waiting].distance;
    for (; waiting < seeds.size() && seeds[waiting].distance <= horizon; ++waiting)
      if (seeds[waiting].distance < field[seeds[waiting].vertex] || seeds[waiting].distance == 0.0F) {
        field[seeds[waiting].vertex] = seeds[waiting].distance;
        buckets.push(seeds[waiting].vertex, seeds[waiting].distance);
      }
    if (buckets.empty()) continue;
    const Seed at = buckets.pop();
    if (at.distance > field[at.vertex]) continue;
    horizon = std::max(horizon, at.distance);
    for (Index k = graph.offset[at.vertex]; k < graph.offset[at.vertex + 1]; ++k) {
      const Link& link = graph.links[k];
      const float distance = at.distance + link.length;
      if (distance > field[link.to]) continue;
      if (reached(at.vertex, link.to, distance < field[link.to])) {
        field[link.to] = distance;
        buckets.push(link.to, distance);
      }
    }
  }
}

}  // namespace

Field distances(const EdgeGraph& graph, std::span<const Seed> seeds) {
  Field field(graph.vertex_count(), kUnreachable);
  std::vector<Seed> valid;
  for (const Seed& seed : seeds)
    if (seed.vertex < field.size() && seed.distance >= 0.0F) valid.push_back(seed);
  run(graph, std::move(valid), field, [](Index, Index, bool shorter) { return shorter; });
  return field;
}

Field distances_from(const EdgeGraph& graph, Index source) {
  const Seed seed{source, 0.0F};
  return distances(graph, {&seed, 1});
}

NearestSource nearest_sources(const EdgeGraph& graph, std::span<const Index> sources) {
  NearestSource result{Field(graph.vertex_count(), kUnreachable),
                       std::vector<Index>(graph.vertex_count(), kNoIndex)};
  std::vector<Seed> seeds;
  for (std::size_t i = sources.size(); i-- > 0;) {
    if (sources[i] >= graph.vertex_count()) continue;
    if (result.source[sources[i]] == kNoIndex) seeds.push_back({sources[i], 0.0F});
    result.source[sources[i]] = static_cast<Index>(i);
  }
  run(graph, std::move(seeds), result.distance, [&](Index from, Index to, bool shorter) {
    const bool better = shorter || result.source[from] < result.source[to];
    if (better) result.source[to] = result.source[from];
    return better;
  });
  return result;
}

std::vector<Field> distances_each(const engine::Context& context, const EdgeGraph& graph,
                                  std::span<const Index> sources) {
  std::vector<Field> fields(sources.size());
  engine::parallel_for(context, sources.size(), 1,
                       [&](std::size_t i, std::size_t) { fields[i] = distances_from(graph, sources[i]); });
  return fields;
}

std::vector<Index> descend(const EdgeGraph& graph, const Field& field, Index from) {
  std::vector<Index> path;
  if (from >= field.size() || !(field[from] < kUnreachable)) return path;
  for (Index at = from; at != kNoIndex;) {
    path.push_back(at);
    Index next = kNoIndex;
    for (Index k = graph.offset[at]; k < graph.offset[at + 1]; ++k) {
      const Link& link = graph.links[k];
      if (field[link.to] < field[at] && field[link.to] + link.length <= field[at] &&
          (next == kNoIndex || field[link.to] < field[next]))
        next = link.to;
    }
    at = next;
  }
  return path;
}

}  // namespace bodice::geodesic
