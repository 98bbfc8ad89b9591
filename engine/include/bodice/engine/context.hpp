#pragma once

#include <bodice/engine/cancel.hpp>
#include <bodice/engine/executor.hpp>
#include <bodice/engine/log.hpp>

namespace bodice::engine {

class Trace;

/// What every algorithm is handed besides its data: where to run, whom to tell, when to stop.
/// Cheap to copy; the referenced objects must outlive every call that is given the context.
struct Context {
  Executor* executor = &inline_executor();  ///< Never null.
  Log* log = nullptr;                       ///< Null: silent.
  Trace* trace = nullptr;                   ///< Null: no tracing, at no cost.
  CancelToken cancel = {};

  void info(std::string_view message) const {
    if (log) log->write(LogLevel::kInfo, message);
  }
};

}  // namespace bodice::engine
