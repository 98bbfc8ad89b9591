#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <bodice/engine/frame_pipeline.hpp>
#include <bodice/engine/trace.hpp>
#include "workload.hpp"

namespace bodice_bench {

/// How frames run beside preprocessing.
struct Condition {
  std::string name;
  bool fit = false;           ///< whether bodies are prepared, in the background unless `foreground`
  double frames_per_s = 0.0;  ///< 0: one frame after the other
  int frame_workers = 0;      ///< of PipelineOptions
  bodice::engine::BackgroundYield yield = bodice::engine::BackgroundYield::kStay;
  bool foreground = false;  ///< the body is prepared inside a frame
};

/// Times of the frames and of the preparations under one condition.
struct Row {
  std::string name;
  std::size_t frames = 0;
  double p50_ms = 0.0, p99_ms = 0.0, max_ms = 0.0;
  /// Times from the submission of the first fit to its first and its last result in a frame, and to the end
  /// of its job; 0 without a fit.
  double first_result_ms = 0.0, last_result_ms = 0.0, fit_ms = 0.0;
  int fits = 0;
  double other_load = 0.0;  ///< share of the machine's time that other programs took meanwhile
};

/// Runs frames for at least `least_s` seconds. With a fit, one body is prepared after the other, so that work
/// waits behind every frame that counts; the call ends after the last preparation.
Row measure(const Condition& condition, Workload& work, bodice::engine::Executor& executor, double least_s,
            bodice::engine::Trace* trace);

/// Milliseconds of a preparation with all workers and no frames.
double foreground_fit_ms(const Workload& work, bodice::engine::Executor& executor);

/// A picture of `length_ms` of `trace`, from 400 ms after the first event of the given name. Each thread has
/// a lane; frames and background work have different colors.
std::string timeline_svg(const bodice::engine::Trace& trace, std::string_view from_event, double length_ms);

}  // namespace bodice_bench
