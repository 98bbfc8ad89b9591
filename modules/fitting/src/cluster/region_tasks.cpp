#include "cluster/region_tasks.hpp"

#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include <bodice/engine/task_graph.hpp>

namespace bodice::inline v0_1::fitting {
namespace {

/// Publishes regions in their order, whatever order their tasks end in. A worker does not wait: if an earlier
/// region is not ready, or another worker is publishing, it leaves its region in the queue.
class InOrder {
 public:
  InOrder(const std::vector<Region>& regions, const RegionTasks& tasks) : on_part_(tasks.on_part) {
    for (const Region& region : regions)
      if (wanted(region, tasks.parts)) queue_.push_back({&region, std::nullopt});
  }

  void give(const Region& region, const std::vector<proxy::ProxyEllipsoid>& ellipsoids) {
    if (!on_part_) return;
    std::unique_lock lock(mutex_);
    for (Entry& entry : queue_)
      if (entry.region == &region) entry.ellipsoids = ellipsoids;
    if (busy_) return;
    busy_ = true;
    while (next_ < queue_.size() && queue_[next_].ellipsoids) {
      const Entry& entry = queue_[next_++];
      lock.unlock();
      on_part_({entry.region->name, entry.region->parts, *entry.ellipsoids});
      lock.lock();
    }
    busy_ = false;
  }

 private:
  struct Entry {
    const Region* region;
    std::optional<std::vector<proxy::ProxyEllipsoid>> ellipsoids;
  };
  const std::function<void(const FittedPart&)>& on_part_;
  std::mutex mutex_;
  std::vector<Entry> queue_;  // its size is fixed before tasks run
  std::size_t next_ = 0;
  bool busy_ = false;
};

}  // namespace

engine::Result<std::vector<FittedRegion>> run_region_tasks(const engine::Context& context,
                                                           const std::vector<Region>& regions,
                                                           const RegionTasks& tasks) {
  engine::GraphBuilder builder;
  InOrder in_order(regions, tasks);
  const auto shares = builder.add("share ellipsoids", tasks.share);
  std::vector<std::pair<std::size_t, engine::Output<FittedRegion>>> outputs;
  for (std::size_t r = 0; r < regions.size(); ++r) {
    const Region& region = regions[r];
    if (!wanted(region, tasks.parts)) continue;
    const auto fit = [&, r](const engine::Context& inner, const std::vector<int>& share) {
      FittedRegion fitted = tasks.fit(inner, regions[r], share[r]);
      in_order.give(regions[r], fitted.ellipsoids);
      return fitted;
    };
    const auto output = builder.add(std::string(tasks.verb) + " " + std::string(region.name), fit, shares);
    builder.set_priority(output, static_cast<int>(region.items.size()));
    outputs.emplace_back(r, output);
  }
  auto graph = std::move(builder).build();
  if (!graph) return graph.error();
  if (auto ran = graph->run(context); !ran) return ran.error();
  std::vector<FittedRegion> results(regions.size());
  for (const auto& [r, output] : outputs) results[r] = graph->take(output);
  return results;
}

}  // namespace bodice::fitting
