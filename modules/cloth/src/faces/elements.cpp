#include "faces/elements.hpp"

#include <algorithm>

#include <bodice/engine/parallel.hpp>

#include "base/schedule.hpp"

namespace bodice::cloth {

Elements make_elements(const geometry::TriMesh& mesh, const Topology& topology) {
  const std::size_t size = block_size(mesh.positions.size());
  const std::size_t blocks = engine::block_count(mesh.positions.size(), size);
  std::vector<std::pair<std::size_t, Element>> grouped;
  auto add = [&](Index a, Index b, Index c) {
    const bool inside = a / size == b / size && a / size == c / size;
    grouped.push_back({inside ? a / size : blocks, {a, b, c}});
  };
  for (const Edge& edge : topology.edges) add(edge.a, edge.b, edge.b);
  for (const Triangle& t : mesh.triangles) add(t[0], t[1], t[2]);
  std::ranges::stable_sort(grouped, {}, [](const auto& g) { return g.first; });
  Elements elements;
  for (const auto& [group, element] : grouped) {
    while (elements.group_begin.size() <= group)
      elements.group_begin.push_back(static_cast<std::uint32_t>(elements.all.size()));
    elements.all.push_back(element);
  }
  elements.group_begin.resize(blocks + 2, static_cast<std::uint32_t>(elements.all.size()));
  return elements;
}

}  // namespace bodice::cloth
