#include "faces/elements.hpp"

#include <algorithm>

#include <bodice/engine/parallel.hpp>

#include "base/schedule.hpp"

namespace bodice::inline v0_1::cloth {
namespace {

struct Grouped {
  std::size_t group;
  Element element;

  std::pair<std::size_t, Index> key() const { return {group, std::ranges::min(element.particle)}; }
};

std::vector<Grouped> grouped_elements(const geometry::TriMesh& mesh, const Topology& topology) {
  const std::size_t size = block_size(mesh.positions.size());
  const std::size_t blocks = engine::block_count(mesh.positions.size(), size);
  std::vector<Grouped> grouped;
  auto add = [&](Index a, Index b, Index c) {
    const bool inside = a / size == b / size && a / size == c / size;
    grouped.push_back({inside ? a / size : blocks, {a, b, c}});
  };
  for (const Edge& edge : topology.edges) add(edge.a, edge.b, edge.b);
  for (const Triangle& t : mesh.triangles) add(t[0], t[1], t[2]);
  std::ranges::stable_sort(grouped, {}, &Grouped::key);
  return grouped;
}

void find_clusters(Elements& elements) {
  elements.cluster_begin.push_back(0);
  std::vector<std::uint32_t> met;
  for (std::size_t run = 0; run < elements.runs(); ++run) {
    met.clear();
    for (std::uint32_t e = elements.run_begin[run]; e < elements.run_begin[run + 1]; ++e)
      for (const Index i : elements.all[e].particle)
        met.push_back(static_cast<std::uint32_t>(i / kTravelCluster));
    std::ranges::sort(met);
    const auto repeated = std::ranges::unique(met);
    elements.cluster.insert(elements.cluster.end(), met.begin(), repeated.begin());
    elements.cluster_begin.push_back(static_cast<std::uint32_t>(elements.cluster.size()));
  }
}

}  // namespace

Elements make_elements(const geometry::TriMesh& mesh, const Topology& topology) {
  const std::size_t blocks = engine::block_count(mesh.positions.size(), block_size(mesh.positions.size()));
  Elements elements;
  for (const auto& [group, element] : grouped_elements(mesh, topology)) {
    while (elements.group_run.size() <= group) {
      elements.group_run.push_back(static_cast<std::uint32_t>(elements.run_begin.size()));
      elements.run_begin.push_back(static_cast<std::uint32_t>(elements.all.size()));
    }
    if (elements.all.size() == elements.run_begin.back() + kRun)
      elements.run_begin.push_back(static_cast<std::uint32_t>(elements.all.size()));
    elements.all.push_back(element);
  }
  elements.group_run.resize(blocks + 2, static_cast<std::uint32_t>(elements.run_begin.size()));
  elements.run_begin.push_back(static_cast<std::uint32_t>(elements.all.size()));
  find_clusters(elements);
  return elements;
}

}  // namespace bodice::cloth
