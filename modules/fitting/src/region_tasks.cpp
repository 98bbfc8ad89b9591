#include "region_tasks.hpp"

#include <mutex>
#include <string>

#include <bodice/engine/task_graph.hpp>

namespace bodice::fitting {

engine::Result<std::vector<FittedRegion>> run_region_tasks(const engine::Context& context,
                                                           const std::vector<Region>& regions,
                                                           const RegionTasks& tasks) {
  engine::GraphBuilder builder;
  std::mutex one_at_a_time;
  const auto shares = builder.add("share ellipsoids", tasks.share);
  std::vector<engine::Output<FittedRegion>> outputs;
  for (std::size_t r = 0; r < regions.size(); ++r) {
    const Region& region = regions[r];
    const auto fit = [&, r](const engine::Context& inner, const std::vector<int>& share) {
      FittedRegion fitted = tasks.fit(inner, regions[r], share[r]);
      if (tasks.on_part) {
        const std::lock_guard lock(one_at_a_time);
        tasks.on_part({regions[r].name, regions[r].parts, fitted.ellipsoids});
      }
      return fitted;
    };
    outputs.push_back(builder.add(std::string(tasks.verb) + " " + std::string(region.name), fit, shares));
    builder.set_priority(outputs.back(), static_cast<int>(region.items.size()));
  }
  auto graph = std::move(builder).build();
  if (!graph) return graph.error();
  if (auto ran = graph->run(context); !ran) return ran.error();
  std::vector<FittedRegion> results;
  for (const auto& output : outputs) results.push_back(graph->get(output));
  return results;
}

}  // namespace bodice::fitting
