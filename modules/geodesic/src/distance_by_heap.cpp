// Based on: Edsger W. Dijkstra. A note on two problems in connexion with graphs. 1959.
// Differs: a vertex may wait in the heap more than once; only its shortest entry counts.
#include <queue>

#include <bodice/geodesic/distance_by_heap.hpp>

namespace bodice::inline v0_1::geodesic {

using geometry::Index;

Field distances_by_heap(const EdgeGraph& graph, std::span<const Seed> seeds) {
  Field field(graph.vertex_count(), kUnreachable);
  using Entry = std::pair<float, Index>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (const Seed& seed : seeds)
    if (seed.vertex < field.size() && seed.distance < field[seed.vertex]) {
      field[seed.vertex] = seed.distance;
      queue.push({seed.distance, seed.vertex});
    }
  while (!queue.empty()) {
    const auto [distance, vertex] = queue.top();
    queue.pop();
    if (distance > field[vertex]) continue;
    for (Index k = graph.offset[vertex]; k < graph.offset[vertex + 1]; ++k) {
      const float through = distance + graph.links[k].length;
      if (through >= field[graph.links[k].to]) continue;
      field[graph.links[k].to] = through;
      queue.push({through, graph.links[k].to});
    }
  }
  return field;
}

}  // namespace bodice::geodesic
