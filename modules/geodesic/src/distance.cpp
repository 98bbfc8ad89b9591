// Based on: Ulrich Meyer, Peter Sanders. Delta-stepping: a parallelizable shortest path algorithm. 2003.
// Differs: one thread a run (sources run in parallel), and a circular array of buckets no wider than a
// typical link. Rounded addition is monotone, so that the least fixed point, and with it every bit of the
// result, is that of Dijkstra's method.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include <bodice/engine/parallel.hpp>
#include <bodice/geodesic/distance.hpp>

namespace bodice::inline v0_1::geodesic {
namespace {

using geometry::Index;
using geometry::kNoIndex;

/// Bucket width in mean link lengths. It is wide enough to visit few empty buckets, and narrow enough to
/// settle few vertices twice.
constexpr float kBucketWidth = 0.35F;
/// A bound on the number of buckets. Meshes with a link thousands of times the mean get wider buckets
/// instead.
constexpr std::size_t kMostBuckets = 1 << 12;

class Buckets {
 public:
  explicit Buckets(const EdgeGraph& graph) {
    const float wanted = kBucketWidth * graph.mean;
    const float least = graph.longest / static_cast<float>(kMostBuckets - 3);
    const float width = std::max({wanted, least, std::numeric_limits<float>::min()});
    scale_ = 1.0F / width;
    ring_.resize(std::bit_ceil(static_cast<std::size_t>(graph.longest * scale_) + 3));
    mask_ = ring_.size() - 1;
  }
  void push(const Seed& entry) {
    ring_[slot(entry.distance) & mask_].push_back(entry);
    ++size_;
  }
  /// Moves the nearest bucket's entries to `bucket`. Entries that are pushed into it later come with the next
  /// call. Precondition: not empty.
  void pop(std::vector<Seed>& bucket) {
    while (ring_[current_ & mask_].empty()) ++current_;
    bucket.clear();
    bucket.swap(ring_[current_ & mask_]);
    size_ -= bucket.size();
  }
  bool empty() const { return size_ == 0; }

 private:
  std::size_t slot(float distance) const {
    return std::max(current_, static_cast<std::size_t>(static_cast<std::int64_t>(distance * scale_)));
  }
  std::vector<std::vector<Seed>> ring_;  ///< a power of two, so that a slot is found without a division
  std::size_t mask_ = 0;
  float scale_ = 1.0F;
  std::size_t current_ = 0;
  std::size_t size_ = 0;
};

// A processor cannot predict whether a link shortens a path, or whether an entry is outdated. Hence both
// loops below first gather, without branches, the entries to work on.

void drop_outdated(std::vector<Seed>& entries, const Field& field) {
  std::size_t count = 0;
  for (const Seed& entry : entries) {
    const bool live = entry.distance <= field[entry.vertex];
    entries[count] = entry;
    count += live;
  }
  entries.resize(count);
}

/// Follows the links of a vertex that shorten a path, or give another one of the same length.
template <class Reached>
void relax(const EdgeGraph& graph, const Seed& at, Field& field, Buckets& buckets, Reached reached) {
  constexpr Index kBlock = 32;
  std::array<Seed, kBlock> nearer;
  const Index end = graph.offset[at.vertex + 1];
  for (Index begin = graph.offset[at.vertex]; begin < end; begin += std::min(kBlock, end - begin)) {
    const Index stop = begin + std::min(kBlock, end - begin);
    std::size_t count = 0;
    for (Index k = begin; k < stop; ++k) {
      const Link& link = graph.links[k];
      const float distance = at.distance + link.length;
      nearer[count] = {link.to, distance};
      count += distance <= field[link.to];
    }
    for (std::size_t i = 0; i < count; ++i) {
      const Seed& to = nearer[i];
      if (to.distance > field[to.vertex]) continue;  // a shorter link of the same row leads to that vertex
      if (!reached(at.vertex, to.vertex, to.distance < field[to.vertex])) continue;
      field[to.vertex] = to.distance;
      buckets.push(to);
    }
  }
}

float nearest_of(const std::vector<Seed>& entries) {
  float least = kUnreachable;
  for (const Seed& entry : entries) least = std::min(least, entry.distance);
  return least;
}

/// Settles every vertex that is no farther than `most`; others keep the last distance found for them, if any.
/// Seeds that start later than one ring ahead would alias an earlier bucket, so that they wait, sorted,
/// outside.
template <class Reached>
void run(const EdgeGraph& graph, std::vector<Seed> seeds, float most, Field& field, Reached reached) {
  Buckets buckets(graph);
  std::stable_sort(seeds.begin(), seeds.end(),
                   [](const Seed& a, const Seed& b) { return a.distance < b.distance; });
  std::size_t waiting = 0;
  float horizon = 0.0F;
  std::vector<Seed> front;
  while (waiting < seeds.size() || !buckets.empty()) {
    if (buckets.empty()) horizon = seeds[waiting].distance;
    for (; waiting < seeds.size() && seeds[waiting].distance <= horizon; ++waiting)
      if (seeds[waiting].distance < field[seeds[waiting].vertex] || seeds[waiting].distance == 0.0F) {
        field[seeds[waiting].vertex] = seeds[waiting].distance;
        buckets.push(seeds[waiting]);
      }
    if (buckets.empty()) continue;
    buckets.pop(front);
    drop_outdated(front, field);
    if (most < kUnreachable && nearest_of(front) > most) front.clear();
    for (const Seed& at : front) {
      horizon = std::max(horizon, at.distance);
      relax(graph, at, field, buckets, reached);
    }
  }
}

}  // namespace

Field distances(const EdgeGraph& graph, std::span<const Seed> seeds) {
  return distances_within(graph, seeds, kUnreachable);
}

Field distances_within(const EdgeGraph& graph, std::span<const Seed> seeds, float most) {
  Field field(graph.vertex_count(), kUnreachable);
  std::vector<Seed> valid;
  for (const Seed& seed : seeds)
    if (seed.vertex < field.size() && seed.distance >= 0.0F) valid.push_back(seed);
  run(graph, std::move(valid), most, field, [](Index, Index, bool shorter) { return shorter; });
  for (float& distance : field) distance = distance <= most ? distance : kUnreachable;
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
  run(graph, std::move(seeds), kUnreachable, result.distance, [&](Index from, Index to, bool shorter) {
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
