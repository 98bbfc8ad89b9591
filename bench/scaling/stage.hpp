#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <bodice/engine/context.hpp>

namespace bodice_bench {

/// One run of a stage; returns a hash of its result, which must not depend on the workers.
using Work = std::function<std::uint64_t(const bodice::engine::Context&)>;

/// A row of the scaling tables. `make` sets up work of about `size` elements, outside of the timing.
struct Stage {
  std::string name;
  std::string element;  ///< what size counts
  std::size_t quick_size, full_size;
  std::function<Work(std::size_t size)> make;
  /// Whether the stage distributes its blocks itself, so that work and span cannot be measured from outside.
  bool draws_blocks = false;
};

// The engine's own loops.
Stage arithmetic_stage();
Stage reduce_stage();
// The layers, in the order of the data flow.
Stage dijkstra_stage();
Stage mvee_stage();
Stage kmeans_stage();
Stage fit_stage();
Stage collision_stage();
Stage cloth_stage();
Stage frame_stage();

inline std::vector<Stage> all_stages() {
  return {arithmetic_stage(), reduce_stage(),    dijkstra_stage(), mvee_stage(), kmeans_stage(),
          fit_stage(),        collision_stage(), cloth_stage(),    frame_stage()};
}

}  // namespace bodice_bench
