#pragma once

#include <string>
#include <vector>

#include <bodice/engine/result.hpp>
#include <bodice/engine/trace.hpp>

namespace bodice::inline v0_1::engine {

/// Times a stage from construction to stop() or destruction, appends it to `stages` and traces it.
///     { StageTimer timer(context, result.stages, "geodesic"); ... }
class StageTimer {
 public:
  StageTimer(const Context& context, std::vector<StageTime>& stages, std::string name)
      : context_(context), stages_(&stages), stage_{std::move(name)}, begin_ns_(context.clock->now_ns()) {}
  ~StageTimer() { stop(); }
  StageTimer(const StageTimer&) = delete;
  StageTimer& operator=(const StageTimer&) = delete;

  /// Ends the stage now; later calls do nothing.
  void stop() {
    if (!stages_) return;
    const std::int64_t end_ns = context_.clock->now_ns();
    stage_.ms = static_cast<double>(end_ns - begin_ns_) * 1e-6;
    if (context_.trace) context_.trace->record(stage_.name, begin_ns_, end_ns);
    stages_->push_back(std::move(stage_));
    stages_ = nullptr;
  }

 private:
  Context context_;
  std::vector<StageTime>* stages_;
  StageTime stage_;
  std::int64_t begin_ns_;
};

}  // namespace bodice::engine
