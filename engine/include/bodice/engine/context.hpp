#pragma once

#include <bodice/engine/cancel.hpp>
#include <bodice/engine/clock.hpp>
#include <bodice/engine/executor.hpp>
#include <bodice/engine/log.hpp>

namespace bodice::inline v0_1::engine {

class Trace;

/// The surroundings of a call: where it runs, where its messages go, and what cancels it. Every algorithm
/// takes one besides its data. Copies are cheap; the referenced objects must outlive every call that is given
/// the context.
struct Context {
  Executor* executor = &inline_executor();  ///< Never null.
  Log* log = nullptr;                       ///< Null: messages are dropped.
  Trace* trace = nullptr;                   ///< Null: no tracing, at no cost.
  CancelToken cancel = {};
  const Clock* clock = &steady_clock();  ///< Never null. For time budgets; results must not depend on it.

  /// Writes a message of level kInfo to the log, if there is one.
  void info(std::string_view message) const {
    if (log) log->write(LogLevel::kInfo, message);
  }
  /// A point at which long work may stop: it throws Canceled, or lets a frame go first (FramePipeline). Every
  /// block of parallel_for passes one; a serial loop of more than a millisecond should pass one now and then.
  void checkpoint() const {
    cancel.check();
    executor->yield();
  }

  /// Writes a message of level kWarning to the log, if there is one.
  void warn(std::string_view message) const {
    if (log) log->write(LogLevel::kWarning, message);
  }
};

}  // namespace bodice::engine
